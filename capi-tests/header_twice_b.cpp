#include <cstk.h>

const char *version_seen_by_b();

const char *version_seen_by_b() { return cstk_version(); }
