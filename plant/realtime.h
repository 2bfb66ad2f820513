#pragma once
// The real-time contract of a function, checked by machine: FEEDTWIN_REALTIME after noexcept says that it never blocks,
// allocates, locks or throws. clang verifies it at compile time (-Wfunction-effects) and RealtimeSanitizer at run time.

#if defined(__clang__) && __clang_major__ >= 20
#define FEEDTWIN_REALTIME [[clang::nonblocking]]
#else
#define FEEDTWIN_REALTIME
#endif
