#include "lorica/human/regions.h"
