/* SPDX-License-Identifier: MIT */
/* Closes what begin.h has opened. */
#if defined(__GNUC__) && !defined(USUB_REPORT_UNUSED)
#pragma GCC diagnostic pop
#endif
#ifdef __cplusplus
}
#endif
