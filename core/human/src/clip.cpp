#include "lorica/human/clip.h"
