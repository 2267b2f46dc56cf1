#include "lorica/human/skeleton.h"
