/* Marks in a run under callgrind: what is counted, and where one count ends. */
#include <valgrind/callgrind.h>

void marks_begin(void)
{
    CALLGRIND_START_INSTRUMENTATION;
}

void marks_toggle(void) /* counting begins, or pauses */
{
    CALLGRIND_TOGGLE_COLLECT;
}

void marks_forget(void)
{
    CALLGRIND_ZERO_STATS;
}

void marks_end(const char *name)
{
    CALLGRIND_DUMP_STATS_AT(name);
}
