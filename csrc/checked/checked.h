/* SPDX-License-Identifier: MIT */
/** @file checked.h
 * Checked calls of a routine (scene setting `checked`).
 *
 * Every argument lies in pages of its own between pages that nobody may touch. A call of the
 * routine becomes several *passes* over the same input: in the first the arguments end where their
 * pages end, in the second they begin where their pages begin, with other garbage in outputs and on
 * the stack. What a correct routine answers is the same in both. The answers that go on are those
 * of the first pass.
 *
 * room.c: the pages. extent.c: sizes and names of elements. pass.c: one pass. judge.c: what passes
 * say about each other. checked.c: a call of the driver. observed.c: what the host asks.
 */
#ifndef USERSUB_CHECKED_H
#define USERSUB_CHECKED_H

#include <sys/types.h>

#include "../driver/internal.h"

#define USUB_MAX_RANK 3

/** One dimension of an argument: a number, plus the value of an integer argument. */
typedef struct usub_term {
  int32_t argument; /* -1: none */
  int64_t constant;
} usub_term;

/** The documented size of an argument in one call. */
typedef struct usub_extent {
  int32_t rank; /* 0: one number */
  int64_t dims[USUB_MAX_RANK];
  size_t element, bytes; /* of one element, of all */
} usub_extent;

/** Pages of one argument. */
typedef struct usub_room {
  char *shown;           /* first byte of its pages, as the routine sees them */
  char *open;            /* the same memory, which the driver may always write */
  char *low, *high;      /* addresses around the pages that belong to nobody else */
  size_t capacity;       /* bytes of its pages */
  size_t accessible;     /* of these, what the routine may touch in this call */
  size_t offset, filled; /* where the argument lies: bytes from `shown`, and how many */
  size_t kept;           /* place of its answer in `kept` of the checker */
  int writes;            /* the routine may write here */
} usub_room;

/** What one pass is to be like. */
typedef struct usub_pass {
  int speaks;      /* messages of the routine are handed on */
  int at_start;    /* arguments begin with their pages; else they end with them */
  int garbage;     /* which garbage lies on the stack: 0 or 1 */
  int32_t lm;      /* FRIC: LM on entry; -1 as it is */
  uint64_t poison; /* arguments (bits) whose memory is poisoned before the call */
  uint64_t closed; /* arguments whose pages are closed until the routine touches them */
} usub_pass;

/** How a pass ended. */
typedef struct usub_outcome {
  int32_t status; /* of the routine or of what ended it */
  int32_t what;   /* USUB_SAW_... */
  int32_t argument, access, flags;
  int64_t element;
  uint64_t place, read, written;
  char reason[400];
} usub_outcome;

/** Outputs (bits) that a pass has not written, and their first such elements. */
typedef struct usub_unwritten {
  uint64_t arguments;
  int64_t first[USUB_MAX_ARGS];
} usub_unwritten;

/** What a worker of a checked driver has. */
typedef struct usub_checker {
  pid_t process; /* the memory is shared with a forked child, which needs its own */
  char *reserve, *pages;
  size_t reserve_bytes, pages_bytes;
  usub_room rooms[USUB_MAX_ARGS];
  usub_term terms[USUB_MAX_ARGS][USUB_MAX_RANK];
  usub_extent extents[USUB_MAX_ARGS];
  void *argv[USUB_MAX_ARGS];
  int32_t count, n; /* arguments; points that the rooms are laid out for */
  char *kept;       /* answers of the first pass */
  uintptr_t code[2];
  uint64_t writable, outputs; /* arguments that the routine may write; that it only writes */
  uint64_t zeroed;            /* outputs that are zero on entry: the contract says so */
  uint64_t traced;            /* arguments closed in the pass under way */
  usub_outcome *tracing;      /* receives what it touches */
  usub_observed seen;         /* of this call of the host */
} usub_checker;

static inline uint64_t usub_bit(int32_t argument) {
  return (uint64_t)1 << argument;
}

/* room.c */
/** Makes the memory of a worker; NULL if there is none. */
usub_checker *usub_checker_create(const usub_driver *driver, const usub_call *call);
void usub_checker_free(usub_checker *checker);
/** Lays the rooms out for the `n` points of the call. */
void usub_rooms_lay(const usub_driver *driver, const usub_call *call, usub_checker *checker);
/** Puts the arguments of the call into their rooms. */
void usub_rooms_fill(const usub_driver *driver, const usub_call *call, usub_checker *checker,
                     const usub_pass *pass);
/** Room whose addresses include `address`; -1 if it is none's. */
int32_t usub_room_at(const usub_checker *checker, uintptr_t address);
/** Closes the rooms of `arguments`, or opens them again. */
void usub_rooms_close(usub_checker *checker, uint64_t arguments, int closed);
/** For a fault in a closed room: opens it for this access. 0 if the fault is another one. */
int usub_room_open(void *checker, uintptr_t address, int32_t access, void *machine);
/** First element that was written outside of an argument, in bytes from its first one.
 * @return the argument, or -1 if all is as it was */
int32_t usub_rooms_damaged(usub_checker *checker, int64_t *bytes);
/** Element `i` of the poison of an argument. */
int usub_is_poison(const usub_extent *extent, const char *element);
/** Whether the argument is not there: left out by the plan. */
int usub_is_left_out(const usub_driver *driver, int32_t argument);
/** Whether the scene has no such thing, so that zeros stand for it. */
int usub_is_absent(const usub_driver *driver, const usub_call *call, int32_t argument);

/* extent.c */
void usub_terms_read(const usub_driver *driver, usub_checker *checker);
/** Documented size of an argument in a call of `n` points. */
usub_extent usub_extent_of(const usub_driver *driver, const usub_call *call,
                           const usub_checker *checker, int32_t argument, int32_t n);
/** Indices from one, in Fortran's order; elements outside have a last index outside. */
void usub_index_of(const usub_extent *extent, int64_t element, int64_t index[USUB_MAX_RANK]);
/** "TAU(3)". */
void usub_element_text(const usub_arg *arg, const usub_extent *extent, int64_t element, char *text,
                       size_t size);
/** ", of which there are 2 x 4". */
void usub_count_text(const usub_arg *arg, const usub_extent *extent, char *text, size_t size);
/** Contact point of the call that an element belongs to, -1 if it belongs to none or to all. */
int32_t usub_point_of(const usub_driver *driver, const usub_checker *checker, int32_t argument,
                      int64_t element, int32_t n);

/** How a pass ended, in words, without the point. */
void usub_outcome_text(const usub_driver *driver, const usub_checker *checker,
                       const usub_outcome *outcome, char *text, size_t size);

/* pass.c */
void usub_pass_run(const usub_driver *driver, usub_call *call, usub_checker *checker,
                   const usub_pass *pass, usub_outcome *outcome);

/* judge.c */
/** Keeps the answers of the first pass. */
void usub_answers_keep(usub_checker *checker);
/** Whether the last pass answered otherwise than the first. Elements of poisoned arguments that
 * still hold the poison and held the preset in the first pass were not written: they do not count,
 * and go into `unwritten`.
 * @return 1 with argument and element in `outcome`, 0 if it did not */
int usub_answers_differ(const usub_call *call, const usub_checker *checker, const usub_pass *pass,
                        usub_outcome *outcome, usub_unwritten *unwritten);
/** Runs another pass and compares how it ended and what it answered with the first one. */
int usub_pass_differs(const usub_driver *driver, usub_call *call, usub_checker *checker,
                      const usub_outcome *first, const usub_pass *pass, usub_outcome *outcome,
                      usub_unwritten *unwritten);
/** Whether the routine answers otherwise although nothing is different; `other` then says how. */
int usub_is_not_repeated(const usub_driver *driver, usub_call *call, usub_checker *checker,
                         const usub_outcome *first, usub_outcome *other);
/** Finds out why the answers of two passes are not the same; `other` is how the second ended. */
void usub_explain_difference(const usub_driver *driver, usub_call *call, usub_checker *checker,
                             const usub_outcome *first, const usub_pass *pass, usub_outcome *other);
/** Outputs that a host cannot do without, and that the routine has not written; and those that it
 * can do without, in `seen`. `outcome` receives what is wrong. */
void usub_judge_unwritten(const usub_driver *driver, usub_call *call, usub_checker *checker,
                          usub_unwritten *unwritten, usub_outcome *outcome);

#endif
