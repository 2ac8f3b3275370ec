/* SPDX-License-Identifier: MIT */
/** @file units.h
 * Fortran input and output in routines: errors stop the routine, stops leave no unit locked.
 */
#ifndef USERSUB_RUNTIME_UNITS_H
#define USERSUB_RUNTIME_UNITS_H

/** Notes where the Fortran run-time library of a routine's library (handle of dlopen) is. */
void usub_units_find(void *library);
/** Ends the statements that a routine of this thread left half done; to be called when it is gone.
 */
void usub_units_end_statements(void);

#endif
