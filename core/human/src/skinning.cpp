#include "lorica/human/skinning.h"
