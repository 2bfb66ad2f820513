#pragma once
// The real-time contract of a function, checked by machine: FEEDTWIN_REALTIME after noexcept says that it never blocks,
// allocates, locks or throws. clang verifies it at compile time (-Wfunction-effects) and RealtimeSanitizer at run time.
//
// A call that neither of them can know to be harmless (a non-blocking system call, the clock read in user space) stands
// between FEEDTWIN_ADMIT_BEGIN and FEEDTWIN_ADMIT_END, in a scope of its own, with the reason beside it.

#if defined(__clang__) && __clang_major__ >= 20
#define FEEDTWIN_REALTIME [[clang::nonblocking]]
#if __has_feature(realtime_sanitizer)
#include <sanitizer/rtsan_interface.h>
#define FEEDTWIN_ADMIT_SCOPE const __rtsan::ScopedDisabler feedtwin_admitted;
#else
#define FEEDTWIN_ADMIT_SCOPE
#endif
#define FEEDTWIN_ADMIT_BEGIN \
  _Pragma("clang diagnostic push") _Pragma("clang diagnostic ignored \"-Wfunction-effects\"") FEEDTWIN_ADMIT_SCOPE
#define FEEDTWIN_ADMIT_END _Pragma("clang diagnostic pop")
#else
#define FEEDTWIN_REALTIME
#define FEEDTWIN_ADMIT_BEGIN
#define FEEDTWIN_ADMIT_END
#endif
