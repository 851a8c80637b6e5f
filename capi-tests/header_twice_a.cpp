// The header stands alone in C++ and may be included by several files of one program.
#include <cstk.h>
#include <cstk.h>

const char *version_seen_by_b();

int main() {
    static_assert(sizeof(cstk_status) == 4 && sizeof(cstk_class) == 4, "enums have 4 bytes");
    return version_seen_by_b() == cstk_version() ? 0 : 1;
}
