/* SPDX-License-Identifier: MIT */
/** @file internal.h
 * What the parts of the driver share. Nothing here is seen by a host.
 *
 * Path of a call: a host binds arrays to *slots* (one for each port of the driver); `plan.c`
 * decides once, for every argument of the routine, where its memory comes from (`usub_source`); a
 * call cuts the points into blocks, sets the argument pointers of a block (`usub_call`), calls the
 * routine under a guard, checks what came back, and only at the end changes what is kept.
 */
#ifndef USERSUB_INTERNAL_H
#define USERSUB_INTERNAL_H

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

#include "../runtime/exception.h"
#include "../runtime/guard.h"
#include "../runtime/pool.h"
#include "tables.h"
#include "usersub/usersub.h"

#define USUB_MAX_ARGS 42
#define USUB_MAX_SLOTS 40
#define USUB_TEXT_LENGTH 81
/** Points of FRIC that are treated together: enough to forget what is done once, few enough for the
 * nearest cache. */
#define USUB_LONGEST_RUN 128
/** Seconds that the routine of a checked driver has for one call. */
#define USUB_TIME_LIMIT 2.0

typedef enum {
  USUB_KIND_OF_STANDARD,
  USUB_KIND_OF_EXPLICIT,
  USUB_KIND_OF_COEFFICIENT
} usub_kind_of_driver;

/** How sticking is enforced; in the order of the choices of the scene setting. */
typedef enum {
  USUB_ENFORCE_DEFAULT,
  USUB_ENFORCE_PENALTY,
  USUB_ENFORCE_LAGRANGE,
  USUB_ENFORCE_KINEMATIC
} usub_enforcement;

/** One argument, as in the table. */
typedef struct usub_arg {
  const char *name, *modern;
  int32_t kind;
  const char *shape;
  int32_t intent;
} usub_arg;

/** One array between host and driver, as in the table. */
typedef struct usub_port {
  const char *name;
  int32_t drivers, kind, role;
  const char *shape, *unbound;
} usub_port;

/** One interface in one generation; rows come from the table. */
typedef struct usub_interface {
  const char *name;       /* "vfric_coef" */
  const char *generation; /* "legacy" or "2022" */
  int32_t standard;       /* 1 implicit, 0 explicit */
  int32_t for_driver;     /* USUB_FOR_... bit of its ports */
  const usub_arg *args;
  int32_t count;
} usub_interface;

struct usub_routine {
  const usub_interface *face;
  int32_t generation_known;
  int32_t single;
  int32_t style;
  usub_entry entry;
  void *library; /* dlopen handle or NULL */
  int32_t uses_known, block_safe, thread_safe;
  unsigned char uses[USUB_MAX_ARGS];
};

/** Every setting of a scene; the fields come from the table. */
typedef struct usub_settings {
#define SETTING_INT(key, value, meaning) int32_t key;
#define SETTING_REAL(key, value, meaning) double key;
#define SETTING_TEXT(key, value, choices, meaning) char key[USUB_TEXT_LENGTH];
#include "settings.inc"
#undef SETTING_INT
#undef SETTING_REAL
#undef SETTING_TEXT
} usub_settings;

struct usub_scene {
  usub_settings settings;
  double *props;
  int32_t prop_count;
  char message[512];
};

/** Sizes in the symbols of the port table, plus the size of a real. */
typedef struct usub_sizes {
  int32_t N, D, F, S, P, A, B, M, X, Y, Z, T;
  size_t real;
} usub_sizes;

/** One port of a driver with its memory. */
typedef struct usub_slot {
  const usub_port *port;
  size_t count;     /* elements */
  size_t per_point; /* elements of one contact point; 0 if the array has no point index */
  size_t element;   /* bytes of one element */
  void *data;       /* bound by the host, else `own` */
  void *own;
  void **place; /* field of usub_memory, which always holds `data` */
  int32_t bound;
} usub_slot;

/** Memory of every array by name, NULL where there is none, so that a call need not search. */
typedef struct usub_memory {
#define PORT_NAME(name) void *name;
#include "port_names.inc"
#undef PORT_NAME
} usub_memory;

/** Where the memory of an argument comes from. */
typedef enum {
  USUB_LEFT_OUT, /* nobody reads or writes it: read-only zeros */
  USUB_FIXED,    /* the same pointer in every block */
  USUB_POINTS,   /* the number of contact points of the block */
  USUB_SLICE,    /* host memory plus first point times stride */
  USUB_SCRATCH   /* memory of the worker, filled or emptied by the driver */
} usub_from;

typedef struct usub_source {
  usub_from from;
  const char *what, *why; /* for people */
  const void *data;       /* FIXED: memory of the driver, */
  const usub_slot *slot;  /* or FIXED, SLICE: an array (the host may bind another at any time) */
  size_t per_point;       /* SLICE, SCRATCH: bytes a contact point */
  size_t extra;           /* SCRATCH: bytes besides */
  int32_t used;           /* 1, 0, -1 unknown */
  int32_t bytes, bytes_full;
} usub_source;

/** Arguments and scratch of one worker. */
typedef struct usub_call {
  void *argv[USUB_MAX_ARGS];
  int32_t n;     /* contact points of the call */
  int32_t done;  /* FRIC: the point of the call that the routine is at */
  char *scratch; /* one allocation; the sources' shares, then `axes` */
  void *axes;    /* local direction 1 of the points of a block; NULL where the routine reads it */
  /* Blocks without their open points: which are closed, where their slices are moved to, and how
   * many points the block has while the call is for fewer (0: it is for all). */
  int32_t *closed;
  void *packed[USUB_MAX_ARGS];
  int32_t all;
  double pnewdt;                /* smallest of this worker */
  struct usub_checker *checker; /* of a checked driver (csrc/checked) */
  /* the failure of this worker in its lowest block */
  int32_t failed_block, failed_point, status;
  char message[512];
} usub_call;

/** Times and numbers that arguments point at, in both precisions. */
typedef struct usub_clock {
  int32_t flags[3]; /* step, increment, type of contact (its values are not published: 0) */
  double time[4];   /* step time, total time, increment, friction work */
  float time_f[4];
  int32_t iteration;
  int32_t timed; /* usub_set_time was called */
} usub_clock;

/** Integers that arguments point at. */
typedef struct usub_counts {
  int32_t zero, one, D, F, S, P, T, B, M, X, Y, props, temperatures;
} usub_counts;

/** What a standard driver keeps between calls besides its committed arrays. `trial` memory is
 * written while an iteration runs; the rest is copied when it has succeeded, so that a failed
 * iteration never was, and so that a commit does not depend on what the host does to its arrays. */
typedef struct usub_iteration {
  int32_t open;     /* an increment is open */
  int32_t done;     /* an iteration of it has succeeded: lm, closed, dslip are its answers */
  int32_t complete; /* and no later one has failed: it can be committed */
  int32_t *lm;
  unsigned char *closed, *trial_closed;
  double *dslip, *tau, *sed, *pressure;
  double *trial_state, *trial_elastic, *trial_equivalent, *coefficient;
  unsigned char *by_pressure; /* whether the coefficient depends on the pressure; trial */
  double pnewdt;              /* smallest of the iteration */
} usub_iteration;

struct usub_driver {
  usub_kind_of_driver kind;
  const usub_interface *face;
  usub_routine routine; /* a copy */
  char title[16];       /* upper-case name of the interface, for messages */
  usub_settings set;
  usub_enforcement enforcement;
  usub_sizes size;
  int32_t single, analytical, edges;
  int32_t points; /* present now */
  int32_t block;  /* points a call */
  int32_t threads;
  int32_t prepared;  /* the plan fits the set of bound arrays */
  int32_t aimed;     /* the fixed argument pointers are set */
  int32_t checked;   /* the routine is called in guarded memory */
  int32_t tracing;   /* and what it touches is noted */
  double time_limit; /* seconds that it has for a call; 0: no limit */
  usub_slot slots[USUB_MAX_SLOTS];
  int32_t slot_count;
  usub_memory memory; /* of the slots */
  usub_source sources[USUB_MAX_ARGS];
  int32_t moving[USUB_MAX_ARGS], moving_count;       /* arguments that are slices */
  int64_t stride[USUB_MAX_ARGS];                     /* bytes from point to point of a call */
  int32_t looked_at[USUB_MAX_ARGS], looked_at_count; /* inputs checked in every block */
  const usub_slot *whole[USUB_MAX_ARGS];             /* arrays checked once a call */
  int32_t whole_count;
  usub_call *calls; /* one a worker */
  usub_pool *pool;
  usub_clock clock, accepted; /* now; of the last increment that counts, which is what is saved */
  usub_counts counts;
  char names[3][USUB_NAME_LENGTH];
  void *props; /* end at a page that nobody may touch */
  int32_t prop_count;
  char *props_pages;
  size_t props_bytes;
  void *ones;            /* areas where the host gives none and the routine reads them */
  int32_t *node_numbers; /* 1, 2, ...: global numbers likewise */
  int32_t out_of_memory; /* of the plan */
  /* Read-only zeros for arguments that are left out, `nothing_place` bytes for each. */
  char *nothing;
  size_t nothing_place;
  char missing[256];   /* what the plan lacks */
  usub_iteration last; /* standard */
  double amplitude;    /* of changing friction, in the open or next increment */
  /* explicit */
  void *last_force; /* kept where the routine reads the previous force; by column (explicit.h) */
  int32_t keeps_force, scatters;
  int32_t secondary_matters, main_matters; /* somebody uses the node numbers of that side */
  double dissipation;
  /* where it enforces sticking: what the increment leaves if it succeeds; NULL where not wanted */
  int32_t *trial_condition;
  void *trial_elastic;
  double *point_dissipation;
  /* Explicit and coefficient: routines write to the state itself. */
  void *state_backup;
  size_t state_bytes;
  /* failures */
  atomic_int first_failed; /* lowest block that failed, INT32_MAX if none */
  int32_t failed_point, failed_block;
  char message[1024];
};

/* message.c */
#define USUB_PRINTF(a, b) __attribute__((format(printf, a, b)))
int32_t usub_fail(usub_driver *driver, int32_t status, const char *format, ...) USUB_PRINTF(3, 4);
int32_t usub_error_set(usub_error *error, int32_t status, const char *format, ...)
    USUB_PRINTF(3, 4);
/** Forgets the last failure, as every call does first. */
void usub_start_call(usub_driver *driver);
/** Records a failure of a block; the driver reports the one of the lowest block. */
int32_t usub_block_fail(usub_driver *driver, usub_call *call, int32_t block, int32_t point,
                        int32_t status, const char *format, ...) USUB_PRINTF(6, 7);
/* interface.c */
/** The interface called `name` in `generation` (NULL: the newest); NULL if there is none. */
const usub_interface *usub_interface_find(const char *name, const char *generation);
/** USUB_INTERFACE_... of an interface. */
int32_t usub_interface_key(const usub_interface *face);

/* slots.c */
int32_t usub_slots_create(usub_driver *driver, usub_error *error);
void usub_slots_free(usub_driver *driver);
usub_slot *usub_slot_find(usub_driver *driver, const char *name);
/** The scene setting that counts the nodes of an array, NULL if it is not an array of nodes. */
const char *usub_empty_setting(const usub_slot *slot);
/** Memory of a slot, NULL if nothing is bound or owned. For plans; calls use `memory`. */
void *usub_data(const usub_driver *driver, const char *name);

/* finite.c */
/** Index of the first NaN or infinity in `n` reals, -1 if there is none. */
ptrdiff_t usub_first_bad(const void *data, size_t n, int32_t single);
/** Several arrays of doubles; those of NULL are not there. */
typedef struct usub_span {
  const double *data;
  size_t count;
} usub_span;
/** Whether there is no NaN or infinity in any of them. */
int usub_all_finite(const usub_span *spans, size_t count);
/** The first of a few doubles: a loop of its own costs less than a call. */
static inline int32_t usub_first_bad_of_few(const double *data, int32_t n) {
  for (int32_t i = 0; i < n; ++i)
    if (!(data[i] - data[i] == 0))
      return i;
  return -1;
}

/* plan.c */
/** Whether the routine uses the argument: 1, 0, or -1 if nobody knows. */
int32_t usub_used(const usub_driver *driver, int32_t position);
/** Whether it is passed: it is used, perhaps, or everything is passed. */
int usub_is_wanted(const usub_driver *driver, int32_t position);
/** The same number for all points of all blocks. */
void usub_put_fixed(usub_driver *driver, int32_t position, const void *data);
/** The number of contact points of the block. */
void usub_put_points(usub_driver *driver, int32_t position);
/** An array of the host: a slice if it has a point index, else as it is. If nothing is bound, the
 * argument is `fallback` (FIXED; NULL: zeros). */
void usub_put_array(usub_driver *driver, int32_t position, const char *array, const void *fallback);
/** Notes that `array` is missing if the routine is known to read the argument made of it. */
void usub_need_array(usub_driver *driver, int32_t position, const char *array);
/** Zeros that nobody can write to, for one argument. */
void *usub_nothing(const usub_driver *driver, int32_t position);
void usub_nothing_free(usub_driver *driver);
/** Memory of the driver, `bytes` a point from `data`. */
void usub_put_memory(usub_driver *driver, int32_t position, const void *data, size_t bytes);
/** Memory of the worker that the driver fills ("gathered", "computed") or empties ("output"). */
void usub_put_scratch(usub_driver *driver, int32_t position, size_t per_point, size_t extra,
                      const char *what, const char *why);
/** What is made of "<quantity>_secondary" and "<quantity>_main": scratch if both are bound. */
void usub_put_pair(usub_driver *driver, int32_t position, const char *quantity, size_t per_point,
                   size_t extra, const char *what, const char *why);
/** Notes that the scene has no such thing: zeros are passed. */
void usub_put_absent(usub_driver *driver, int32_t position, size_t per_point, const char *why);
/** Contact points that one call of the routine is for, at most. */
int32_t usub_points_a_call(const usub_driver *driver);
/** Whether the driver has to fill or empty the scratch of an argument. */
int usub_is_live(const usub_driver *driver, int32_t position);
/** Plan of the driver's kind, workers and scratch; refuses if needed arrays are not bound. */
int32_t usub_prepare(usub_driver *driver);
void usub_calls_free(usub_driver *driver);
/** Sets the slices of a block of `n` points from `first`. */
void usub_aim(const usub_driver *driver, usub_call *call, int32_t first, int32_t n);

/* open_points.c */
/** Leaves the open points of a block out of its arguments. Returns how many are closed: points of
 * `call` from now on. */
int32_t usub_leave_open_out(const usub_driver *driver, usub_call *call, int32_t first);
/** Gives the answers of such a call back to their points; open ones get zero. */
void usub_take_open_back(const usub_driver *driver, usub_call *call, int32_t first);
/** Which point of the block the k-th of the call is. */
static inline int32_t usub_point_at(const usub_call *call, int32_t k) {
  return call->all ? call->closed[k] : k;
}

/* inputs.c */
/** Lists the arrays that are looked at: inputs of the routine and what forces are spread with. */
void usub_list_inputs(usub_driver *driver);
/** Whether there is no NaN or infinity in the inputs that `call` aims at. */
int usub_inputs_are_finite(const usub_driver *driver, const usub_call *call);
/** Refuses NaN and infinity in these inputs. */
int32_t usub_check_inputs(usub_driver *driver, usub_call *call, int32_t index, int32_t first);
/** Refuses them in the arrays without a point index, and in shape functions that spread forces. */
int32_t usub_check_whole_inputs(usub_driver *driver);

/* enforcement.c */
usub_enforcement usub_enforcement_of(const usub_settings *set);
/** Refuses settings of enforcement that the driver cannot serve. */
int32_t usub_check_enforcement(const usub_driver *driver, usub_error *error);

/* props.c */
/** Copies the properties. */
int32_t usub_props_create(usub_driver *driver, const usub_scene *scene, usub_error *error);
void usub_props_free(usub_driver *driver);

/* run.c */
/** Calls the routine with the arguments of `call`; the caller holds the guard. */
int32_t usub_call_routine(const usub_driver *driver, usub_call *call);
/** Calls its entry with `argv`, whatever kind of driver it is. */
int32_t usub_call_entry(const usub_driver *driver, usub_call *call, void **argv);
/** FRIC: calls it for `count` of the points of `call`, which are listed in their order; `done` is
 * the one that it is at. */
int32_t usub_call_listed(const usub_driver *driver, usub_call *call, const int32_t *points,
                         int32_t count);
/** The same under a guard; says in `reason` why it ended, if it did. */
int32_t usub_call_guarded(const usub_driver *driver, usub_call *call, char reason[256]);
/** Records that the routine did not return as it should in the block that `call` aims at. */
int32_t usub_ended(usub_driver *driver, usub_call *call, int32_t index, int32_t first,
                   int32_t status, const char *reason);
/** Why a routine ended, from its guard; a fault in an argument that is not there gets its name. */
void usub_explain(const usub_driver *driver, const usub_guard *guard, char reason[256]);
/** One block of points: fills, calls, checks, empties. */
typedef int32_t (*usub_block_fn)(usub_driver *driver, usub_call *call, int32_t index);
/* csrc/checked */
/** Calls the routine of a checked driver. */
int32_t usub_checked_call(const usub_driver *driver, usub_call *call);
/** Records what a checked call that ended with `status` found; 0 if it found nothing. */
int32_t usub_checked_fail(usub_driver *driver, usub_call *call, int32_t index, int32_t first,
                          int32_t status);
/** Forgets what the last call of a checked driver saw. */
void usub_checked_start(usub_driver *driver);
void usub_checker_free(struct usub_checker *checker);

/* run.c */
/** Runs all blocks over the workers and reports the failure of the lowest block. */
int32_t usub_run_blocks(usub_driver *driver);
/** The block function of the driver's kind. */
usub_block_fn usub_block_of(const usub_driver *driver);

/* state.c */
/** Copies the state that the routine writes to, and puts the copy back. */
void usub_state_keep(usub_driver *driver);
void usub_state_restore(usub_driver *driver);

/** Allowable elastic slip of penalty enforcement. */
static inline double usub_critical_elastic_slip(const usub_settings *set) {
  return set->elastic_slip > 0 ? set->elastic_slip
                               : set->slip_tolerance * set->characteristic_length;
}

/* What each kind of driver adds: memory, plan, one block. */
int32_t usub_standard_create(usub_driver *driver);
void usub_standard_free(usub_driver *driver);
void usub_standard_plan(usub_driver *driver);
int32_t usub_standard_block(usub_driver *driver, usub_call *call, int32_t index);
void usub_explicit_plan(usub_driver *driver);
/** Memory of the previous force, if the plan wants it. */
int32_t usub_explicit_memory(usub_driver *driver);
/** Bytes of local directions that a worker needs for `points` points besides its arguments. */
size_t usub_axes_bytes(const usub_driver *driver, size_t points);
size_t usub_force_bytes(const usub_driver *driver);
/* explicit_enforcement.c */
usub_enforcement usub_explicit_enforcement(const usub_driver *driver);
/** Whether an explicit driver has memory of its own for a port: 1, 0, or -1 by the port's role. */
int usub_explicit_owns(const usub_driver *driver, const char *port);
int32_t usub_explicit_create(usub_driver *driver);
void usub_explicit_free(usub_driver *driver);
int32_t usub_explicit_block(usub_driver *driver, usub_call *call, int32_t index);
void usub_coefficient_plan(usub_driver *driver);
int32_t usub_coefficient_block(usub_driver *driver, usub_call *call, int32_t index);

#endif
