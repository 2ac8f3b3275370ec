/* SPDX-License-Identifier: MIT */
/* The probe: a routine behind every interface that writes down how a host calls it.
 *
 * A host loads it in place of a user's library. It never touches the host's memory directly: what
 * it reads and writes goes through the kernel, so that an address that leads nowhere is a line of
 * the record and not the end of the host. What it answers is plain friction, so that hosts run as
 * they would; `usersub.check.hosts` judges the record afterwards. */
#ifndef USUB_PROBE_H
#define USUB_PROBE_H

#include <stddef.h>
#include <stdint.h>

#include "usersub/abi.h"

#define USUB_PROBE_VERSION 1
/** Most arguments of an interface, and most dimensions of one. */
#define USUB_PROBE_ARGUMENTS 48
#define USUB_PROBE_DIMENSIONS 3
/** Bytes of an argument that are looked at, and that are written to the record. */
#define USUB_PROBE_LOOKED_AT (16u << 20)
#define USUB_PROBE_KEPT (4u << 20)

enum { USUB_PROBE_REAL, USUB_PROBE_INT, USUB_PROBE_CHAR };
enum { USUB_PROBE_READ = 1, USUB_PROBE_WRITE = 2 };

/** One argument of an interface: `dimension` holds numbers, or -1 - position of the argument that
 * is the number; `plus` is added to the first one. */
typedef struct usub_probe_argument {
  const char *name;
  int32_t kind, intent, rank;
  int32_t dimension[USUB_PROBE_DIMENSIONS];
  int32_t plus, element; /* element of the array that is the number, from 0 */
} usub_probe_argument;

/** One interface in one generation. */
typedef struct usub_probe_interface {
  const char *name;
  int32_t count, standard;
  usub_probe_argument argument[USUB_PROBE_ARGUMENTS];
} usub_probe_interface;

/** How an argument was found. */
enum {
  USUB_PROBE_FINE,      /* all bytes of the documented size can be read */
  USUB_PROBE_NULL,      /* no address */
  USUB_PROBE_NOWHERE,   /* nothing can be read there */
  USUB_PROBE_SHORT,     /* readable, but not to the end of the documented size */
  USUB_PROBE_UNMEASURED /* its size depends on a count that makes no sense */
};

/** One argument of one call. `data` is a copy of what it held on entry, `answer` of what it was
 * set to (NULL if it was left alone). */
typedef struct usub_probe_value {
  void *address;
  int64_t count;
  size_t bytes, readable;
  int32_t found, refused; /* refused: it cannot be written to */
  unsigned char *data, *answer;
} usub_probe_value;

/** Why a generation or precision was taken. */
enum { USUB_PROBE_TOLD, USUB_PROBE_SEEN, USUB_PROBE_ASSUMED };

/** One call. */
typedef struct usub_probe_call {
  int32_t key; /* USUB_INTERFACE_... */
  int32_t single, precision_basis, generation_basis;
  int64_t sequence, begin, end;
  const usub_probe_interface *face;
  void *const *argv;
  uint64_t lengths[3];
  usub_probe_value value[USUB_PROBE_ARGUMENTS];
} usub_probe_call;

/* tables.c */
const usub_probe_interface *usub_probe_interface_of(int32_t key);
/** Bytes of one element of an argument. */
size_t usub_probe_element(const usub_probe_call *call, int32_t position);

/* memory.c */
/** Reads or writes this process through the kernel; returns how many bytes went well. */
size_t usub_probe_read(const void *address, void *to, size_t bytes);
size_t usub_probe_write(void *address, const void *from, size_t bytes);
/** A piece of memory to be read. */
typedef struct usub_probe_piece {
  const void *address;
  void *to;
  size_t bytes;
} usub_probe_piece;
/** Reads pieces at once; returns 1 if all of them could be read to their end. */
int usub_probe_read_all(const usub_probe_piece *pieces, int32_t count);

/* values.c */
/** Reads every argument; counts first, since sizes depend on them. */
void usub_probe_look(usub_probe_call *call);
void usub_probe_forget(usub_probe_call *call);
/** Element of an argument, 0 where there is none. */
int32_t usub_probe_int(const usub_probe_call *call, int32_t position, int64_t index);
double usub_probe_real(const usub_probe_call *call, int32_t position, int64_t index);
/** Sets an element of the answer; nothing happens where there is none. */
void usub_probe_set(usub_probe_call *call, int32_t position, int64_t index, double value);
/** Hands the answers to the host: elements that changed. */
void usub_probe_hand_over(usub_probe_call *call);

/* record.c */
/** Whether calls are recorded; opens the record at the first call. */
int usub_probe_is_recording(void);
int64_t usub_probe_next_call(void);
/** Writes a call down, if it is `chosen` and the record is not full. */
void usub_probe_record(const usub_probe_call *call, int chosen);

/* points.c */
/** What the script of the run asks of a call of FRIC. */
typedef struct usub_probe_script {
  int32_t lm;       /* to return */
  int32_t cut_back; /* 1 ask for a shorter increment */
} usub_probe_script;
usub_probe_script usub_probe_script_of(const usub_probe_call *call);
/** Whether the call is written down: of hosts that call point by point, a few points are. */
int usub_probe_is_chosen(const usub_probe_call *call);

/* respond.c */
/** Friction coefficient: the first property if it could be one. */
double usub_probe_mu(const usub_probe_call *call, int32_t props, int32_t count);
/** A number in [1, 2) that tells call, point and index; exact in the precision of the call. */
double usub_probe_mark(const usub_probe_call *call, int64_t point, int64_t index);
/** Answers a call of any interface. */
void usub_probe_respond(usub_probe_call *call, const usub_probe_script *script);

/* fric.c */
void usub_probe_fric(usub_probe_call *call, const usub_probe_script *script);

/** Every entry ends here. */
void usub_probe_enter(int32_t key, void *const *argv, const size_t *lengths);

#endif
