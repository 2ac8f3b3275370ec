/* SPDX-License-Identifier: MIT */
#ifndef USERSUB_RUNTIME_MISSING_H
#define USERSUB_RUNTIME_MISSING_H

/** A function that ends the call of the routine and says that `symbol` does not exist; NULL if
 * there are too many such symbols. Never freed. */
void *usub_missing_slot(const char *symbol);

#endif
