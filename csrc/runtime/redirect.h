/* SPDX-License-Identifier: MIT */
/** @file redirect.h
 * Libraries that were built without us; `usub_redirect_stops` is public.
 */
#ifndef USERSUB_RUNTIME_REDIRECT_H
#define USERSUB_RUNTIME_REDIRECT_H

#include "usersub/usersub.h"

/** Lets libraries that are loaded from now on find the utility routines (XIT, GETPARTINFO, ...)
 * that they were not linked against. */
int32_t usub_publish_utilities(void);

#endif
