/* The header stands alone, in strict C99, and may be included twice. */
#include <cstk.h>
#include <cstk.h>

int main(void) {
    const cstk_status status = CSTK_OK;
    const cstk_class classes[] = {CSTK_CLASS_OUTSIDE, CSTK_CLASS_CONTACT, CSTK_CLASS_INSIDE};
    return status == 0 && classes[2] == 2 && cstk_version()[0] == '0' + CSTK_VERSION_MAJOR ? 0 : 1;
}
