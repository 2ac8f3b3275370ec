/* SPDX-License-Identifier: MIT */
/* Opens routines in the headers of laws; read once for each of them. Nobody uses all arguments of
 * an interface; USUB_REPORT_UNUSED, for a loader that wants to know which, has the compiler say. */
#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__) && !defined(USUB_REPORT_UNUSED)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif
