/* SPDX-License-Identifier: MIT */
/** @file usersub.h
 * Friction user subroutines behind block-vectorised drivers, for hosts in C, C++ and (through the
 * generated module `usersub`) Fortran.
 *
 * A host makes a *routine* (user code behind one of the five interfaces), a *scene* (what its model
 * has), and from both a *driver*. It binds its own arrays to the driver by name, once, and from
 * then on a call is one pointer:
 *
 *     usub_routine_open("libmu.so", "vfric_coef", NULL, "double", &routine, &error);
 *     usub_scene_create(&scene);
 *     usub_scene_set_int(scene, "points", n);
 *     usub_driver_create("explicit", routine, scene, &driver, &error);
 *     usub_bind(driver, "normal_force", normal_force, n);
 *     ...
 *     usub_set_time(driver, 1, increment, step_time, total_time, dt);
 *     if (usub_step(driver) < 0) puts(usub_message(driver));
 *
 * The arrays and settings, with shapes and units, stand in the reference pages of the manual
 * ("Arrays of the drivers", "Settings of a scene"); shapes are Fortran-ordered, the contact point
 * is the last index, node numbers count from one.
 *
 * Every function that can fail returns a status of `status.h`: 0 success, positive "valid outputs,
 * but the host should act", negative "state, and arrays that are added to, are as before the call;
 * outputs are not defined". No function prints or exits. Global to the process are only the fault
 * handlers that `usub_catch_faults` and checked drivers install, the receiver of messages, and what
 * the utility routines keep for user code (job name, mutexes, allocatable arrays).
 * A driver may be used by one thread at a time; different drivers are independent.
 */
#ifndef USERSUB_USERSUB_H
#define USERSUB_USERSUB_H

#include <stddef.h>
#include <stdint.h>

#include "abi.h"
#include "status.h"

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

/* tag::cdef[] */

/** User code behind one interface. */
typedef struct usub_routine usub_routine;
/** What a host's model has. */
typedef struct usub_scene usub_scene;
/** A routine in a scene: the plan, the state, the bound arrays. */
typedef struct usub_driver usub_driver;

/** What went wrong where no handle exists yet. Owned by the caller; may be NULL. */
typedef struct usub_error {
  int32_t status;
  char message[1024];
} usub_error;

/** One line of a plan: what becomes of one argument. Strings live as long as the driver. */
typedef struct usub_plan_row {
  const char *argument; /* newer spelling */
  const char *what;     /* "zero-copy", "gathered", "computed", "constant", "left out", "output" */
  const char *why;      /* one clause for people */
  int32_t read;         /* 1 the routine uses it, 0 it does not, -1 not known (taken as used) */
  int32_t bytes;        /* bytes per contact point that are passed in the block */
  int32_t bytes_full;   /* the same if everything were passed */
} usub_plan_row;

/** Any routine entry; cast by the driver to the type of its interface and style. */
typedef void (*usub_entry)(void);

/** Version of the argument tables; compare with USUB_ABI_VERSION of the header. */
int32_t usub_abi_version(void);
/** Hash of the argument tables, 16 hexadecimal digits; compare with USUB_ABI_HASH. */
const char *usub_abi_hash(void);
/** Compares the hash of the header that a host was built with, USUB_ABI_HASH, with the library's.
 * Libraries of routines that include abi.h are compared when they are opened. */
int32_t usub_check_abi(const char *hash, usub_error *error);
/** Release of the library, for example "0.1.0". */
const char *usub_release(void);
/** Name of a status ("CUT_BACK"), or "UNKNOWN". Static. */
const char *usub_status_name(int32_t status);
/** What a status means, one clause. Static. */
const char *usub_status_text(int32_t status);

/* Routines */

/** Loads `interface` ("fric", ..., any case) from a shared library.
 * @param library     path of the library, or NULL for the running program
 * @param interface   name of the interface; the symbol is its lower-case name and one underscore
 * @param generation  "legacy" or "2022" (FRIC_COEF); NULL where it is not known
 * @param precision   "double" or "single": how the library was built
 * @return status; on failure *routine is NULL and `error` says why.
 */
int32_t usub_routine_open(const char *library, const char *interface, const char *generation,
                          const char *precision, usub_routine **routine, usub_error *error);

/** Makes a routine of a function of this process.
 * @param style  USUB_STYLE_FULL: the published argument list with hidden character lengths;
 *               USUB_STYLE_BLOCK: `int f(void **argv)`, the arguments in their order, returns 0 or
 *               a negative status;
 *               USUB_STYLE_POINTS (FRIC): `int32_t f(void **argv, const int64_t *stride,
 *               const int32_t *points, int32_t count, int32_t *done)`, the same for the contact
 *               points k = points[0], ..., points[count - 1] one after the other; argument i of
 *               point k is at argv[i] plus k * stride[i] bytes, where numbers that give sizes and
 *               names have stride 0. It sets *done to k before it begins with point k, and returns
 *               at the first point that fails.
 */
int32_t usub_routine_create(const char *interface, const char *generation, const char *precision,
                            int32_t style, usub_entry entry, usub_routine **routine,
                            usub_error *error);
/** Says what the routine uses: per argument 0 nothing, 1 read, 2 written, 3 both. */
int32_t usub_routine_set_uses(usub_routine *routine, const unsigned char *uses, int32_t count);
/** Promises: "block_safe" (FRIC_COEF: nBlock > 1), "thread_safe" (no COMMON, SAVE or static). */
int32_t usub_routine_set_flag(usub_routine *routine, const char *flag, int32_t value);
/** Frees the routine; drivers made of it must be freed before. NULL is allowed. */
void usub_routine_free(usub_routine *routine);

/* Scenes */

int32_t usub_scene_create(usub_scene **scene);
int32_t usub_scene_set_int(usub_scene *scene, const char *key, int32_t value);
int32_t usub_scene_set_real(usub_scene *scene, const char *key, double value);
int32_t usub_scene_set_text(usub_scene *scene, const char *key, const char *value);
/** Properties of the routine (PROPS); copied, and rounded if the scene is in single precision. */
int32_t usub_scene_set_props(usub_scene *scene, const double *props, int32_t count);
/** Why the last call on this scene failed; "" after success. */
const char *usub_scene_message(const usub_scene *scene);
void usub_scene_free(usub_scene *scene);

/* Drivers */

/** Makes the plan. The scene is copied and may be freed; the routine has to live on.
 * @param kind  "standard" (FRIC, FRIC_COEF), "explicit" (VFRIC, VFRICTION, VFRIC_COEF) or
 *              "coefficient" (FRIC_COEF, VFRIC_COEF without enforcement)
 */
int32_t usub_driver_create(const char *kind, const usub_routine *routine, const usub_scene *scene,
                           usub_driver **driver, usub_error *error);
void usub_driver_free(usub_driver *driver);

/** Binds a host array by name; `count` is its number of elements, `data` NULL unbinds. An array
 * without elements counts as not bound.
 * The memory stays the host's and has to live until it is unbound or the driver freed. */
int32_t usub_bind(usub_driver *driver, const char *array, void *data, size_t count);
/** Memory and size of an array of any role: the host's if bound, else the driver's own; NULL and 0
 * if there is none. Writing to state between increments sets initial conditions. */
int32_t usub_array(usub_driver *driver, const char *array, void **data, size_t *count);
/** Sets how many of the N points are present now (0 ... N). Bound arrays keep their full size;
 * points that are absent from a step or a committed increment count as open. */
int32_t usub_set_points(usub_driver *driver, int32_t points);
/** Sets step and increment number and the times; all at the end of the increment. */
int32_t usub_set_time(usub_driver *driver, int32_t step, int32_t increment, double step_time,
                      double total_time, double time_increment);
/** The last times set, or loaded with a state: numbers[2] step and increment, times[3] step time,
 * total time and time increment. */
int32_t usub_get_time(const usub_driver *driver, int32_t *numbers, double *times);
/** Sets the frictional dissipation that the routine is told (whole model). */
int32_t usub_set_friction_work(usub_driver *driver, double work);

/** Standard: opens an increment; LM, TAU, DSLIP get their values for the first iteration. */
int32_t usub_begin_increment(usub_driver *driver);
/** Standard: one Newton iteration from the committed state, for all closed points.
 * @return USUB_OK, USUB_CUT_BACK if a routine set PNEWDT below 1, or a failure. */
int32_t usub_iterate(usub_driver *driver);
/** Standard: accepts the last iteration, which has to have succeeded; the only call that changes
 * committed state. */
int32_t usub_commit(usub_driver *driver);
/** Standard: forgets the increment. */
int32_t usub_cut_back(usub_driver *driver);
/** Standard: smallest PNEWDT of the last iteration. */
double usub_pnewdt(const usub_driver *driver);
/** Standard: how far friction has changed since the start of the step, 0 to 1, in the increments to
 * come (FRIC_COEF with the scene setting `changing`). Comes before usub_begin_increment; 1 until
 * it is set. */
int32_t usub_set_amplitude(usub_driver *driver, double amplitude);

/** What a symmetric solver would lose of the tangents of an iteration. */
typedef struct usub_symmetry {
  int32_t closed_points, unsymmetric_points;
  double skew;        /* largest skew part of d tau/d gamma, as a fraction of it */
  int32_t skew_point; /* where, from 0; -1 if there is none */
  double pressure;    /* largest d tau/d p, to which nothing is symmetric */
  int32_t pressure_point;
  int32_t solver_switches; /* the commercial solver is assumed to use its unsymmetric solver */
  char sentence[512];
} usub_symmetry;

/** Standard: looks at the tangents of the last iteration.
 * @param skew, pressure  receive the parts of every point, or NULL
 * @param found           receives the summary, or NULL */
int32_t usub_find_symmetry(usub_driver *driver, double *skew, double *pressure,
                           usub_symmetry *found);

/** Explicit: one increment: axes, rotation, routine, forces, scatter. */
int32_t usub_step(usub_driver *driver);
/** Explicit: frictional dissipation summed so far (scene setting `dissipation`). */
double usub_dissipation(const usub_driver *driver);
/** Explicit: elastic energy of all points at the last increment, with the areas bound now; 0 unless
 * the driver keeps elastic slips (VFRIC_COEF by penalty enforcement). */
double usub_elastic_energy(const usub_driver *driver);
/** Coefficient: friction coefficients of all points. */
int32_t usub_evaluate(usub_driver *driver);

/* Checked drivers (scene setting `checked`): every call of the routine is several calls in guarded
 * memory, whose answers are compared. Fault handlers are installed for the process. */

/** What the last call of a checked driver saw. */
enum {
  USUB_SAW_NOTHING = 0,
  USUB_SAW_OUTSIDE = 1,       /* an element outside of an argument was read or written */
  USUB_SAW_INPUT_WRITTEN = 2, /* an argument that is only read was written */
  USUB_SAW_LEFT_OUT = 3,      /* an argument was touched that the routine is said not to use */
  USUB_SAW_NOT_WRITTEN = 4,   /* an output that a host cannot do without was not written */
  USUB_SAW_OUTPUT_READ = 5,   /* an output was read before it was written */
  USUB_SAW_UNINITIALISED = 6, /* a local variable was read before it was set */
  USUB_SAW_NOT_REPEATED = 7,  /* the same input gave another answer */
  USUB_SAW_CRASH = 8,         /* a signal that no argument explains */
  USUB_SAW_STOP = 9,          /* STOP, XIT, exit, abort */
  USUB_SAW_TIME = 10,         /* no return within the time limit */
  USUB_SAW_RED_ZONE = 11      /* memory beside an argument was written; found after the call */
};
/** What was done to an element. */
enum { USUB_ACCESS_UNKNOWN = 0, USUB_ACCESS_READ = 1, USUB_ACCESS_WRITE = 2 };
/** Floating-point exceptions, as bits. Compilers raise some that the source does not. */
enum {
  USUB_FLAG_INVALID = 1,
  USUB_FLAG_DIVISION = 2,
  USUB_FLAG_OVERFLOW = 4,
  USUB_FLAG_UNDERFLOW = 8
};

typedef struct usub_observed {
  int32_t what;       /* USUB_SAW_... */
  int32_t argument;   /* its position, -1 if it is about none */
  int64_t element;    /* from 0 in the order of memory; may lie outside; -1 if it is about none */
  int32_t access;     /* USUB_ACCESS_... */
  int32_t point;      /* contact point from 0, -1 if it is not known */
  int32_t status;     /* of the call */
  int32_t flags;      /* floating-point exceptions of all points */
  uint64_t place;     /* address of the instruction, 0 if it is not known */
  uint64_t unwritten; /* outputs (bit per argument) that some call left as they were */
  uint64_t read;      /* arguments that were touched, if tracing is on: read before written, */
  uint64_t written;   /* and written */
  int32_t rank;       /* indices of the element: their number (0: the argument is one number), */
  int64_t index[3];   /* and they themselves, from 1, in Fortran's order */
  char sentence[512];
} usub_observed;

/** What the last call of a checked driver saw: of the failure, if it failed; bits are of all calls
 * of the routine. WRONG_ORDER unless the driver is checked. */
int32_t usub_get_observed(const usub_driver *driver, usub_observed *observed);
/** Seconds that the routine of a checked driver has for one call; 0: no limit; 2 until it is set.
 * A routine that is ended may leave locks and memory behind. */
int32_t usub_set_time_limit(usub_driver *driver, double seconds);
/** Checked: whether calls also find out which arguments the routine reads and writes. */
int32_t usub_trace(usub_driver *driver, int32_t on);
/** Explicit and coefficient: one call of the routine without any contact point. State stays as it
 * is. */
int32_t usub_call_empty_block(usub_driver *driver);

/** How two threads met in one routine. */
typedef struct usub_meeting {
  int32_t met;                    /* the first thread made that many writes */
  int32_t status_one, status_two; /* of the two calls */
  uint64_t place, address;        /* the instruction that wrote, and where; 0 if there was none */
} usub_meeting;

/** The next call of two drivers of one routine (usub_iterate, usub_step or usub_evaluate), such
 * that all of the second one happens right behind the write number `turn` (from 1) of the first one
 * to data that the library of the routine keeps; after it if there are fewer. Answers that differ
 * from those of one call after the other are due to these data. Both drivers are not checked and
 * have one thread; no other thread may be in the library. Linux on x86-64. */
int32_t usub_meet(usub_driver *one, usub_driver *two, int32_t turn, usub_meeting *meeting);

/** Bytes that `usub_state_save` writes. */
size_t usub_state_size(const usub_driver *driver);
/** Writes the state of the last accepted increment, with its times: versioned, with a check sum, in
 * the byte order of the machine, which the header records. How many points are present is the
 * host's to keep. */
int32_t usub_state_save(const usub_driver *driver, void *buffer, size_t size);
/** Reads a saved state; refuses (and changes nothing) unless version, byte order, interface,
 * sizes and check sum fit. */
int32_t usub_state_load(usub_driver *driver, const void *buffer, size_t size);

/** Why the last call on this driver failed: interface, array or argument, point; "" if it did not.
 */
const char *usub_message(const usub_driver *driver);
/** Contact point (from 0) of the last failure, -1 if none is known. */
int32_t usub_failed_point(const usub_driver *driver);
/** Runs the block of the last failure again through `entry` (block style) on scratch state, so that
 * a slower twin of the routine can say more. Only right after the failure: WRONG_ORDER if something
 * was bound or set since. */
int32_t usub_replay(usub_driver *driver, usub_entry entry);

/** Number of plan lines (arguments of the interface). */
int32_t usub_plan_count(const usub_driver *driver);
int32_t usub_plan_get(const usub_driver *driver, int32_t index, usub_plan_row *row);
/** Contact points a call and threads, as the plan chose them. */
int32_t usub_plan_block(const usub_driver *driver);
int32_t usub_plan_threads(const usub_driver *driver);

/* Helpers for hosts */

/** Stick force of kinematic enforcement: the force that takes the predicted tangential velocity of
 * a node to zero within the increment, mass |v_t| / dt.
 * @param velocity predicted relative velocity (dimension, points); normal likewise */
int32_t usub_stick_force_kinematic(int32_t points, int32_t dimension, const double *velocity,
                                   const double *normal, const double *mass, double time_increment,
                                   double *stick_force);
/** Stick force of penalty enforcement: | F_previous - stiffness ds_t |, the elastic trial force. */
int32_t usub_stick_force_penalty(int32_t points, int32_t dimension, const double *previous_force,
                                 const double *slip_increment, const double *normal,
                                 const double *stiffness, double *stick_force);
int32_t usub_stick_force_kinematic_single(int32_t points, int32_t dimension, const float *velocity,
                                          const float *normal, const float *mass,
                                          float time_increment, float *stick_force);
int32_t usub_stick_force_penalty_single(int32_t points, int32_t dimension,
                                        const float *previous_force, const float *slip_increment,
                                        const float *normal, const float *stiffness,
                                        float *stick_force);

/* Messages and faults */

/** Receives what routines say: level 1 information, -1 warning, -2 error, -3 fatal (STDB_ABQERR,
 * XPLB_ABQERR), `text` is NUL-terminated and lives for the call. */
typedef void (*usub_message_fn)(void *context, int32_t level, const char *text);
/** Sets the receiver for this process; NULL drops messages (the default). It is called by the
 * thread that runs the routine, so by several at once if the scene has threads. */
void usub_set_message_handler(usub_message_fn handler, void *context);
/** Turns arithmetic and memory faults inside routines into USUB_ROUTINE_CRASHED (1) or leaves them
 * to the process (0, the default). Earlier handlers get every other fault. */
int32_t usub_catch_faults(int32_t on);
/** Points the calls of exit, abort, STOP and undefined utility routines in a library that was built
 * without usersub to this one, so that they leave to the driver. `library` is a handle of dlopen
 * (RTLD_LAZY). usub_routine_open does this itself.
 * @return number of calls redirected, 0 where the system is not known, or a negative status. */
int32_t usub_redirect_stops(void *library);
/** What GETJOBNAME and GETOUTDIR answer (default "usersub" and "."). */
int32_t usub_set_job(const char *job_name, const char *output_folder);
/** Ends the analysis that routines know of: the allocatable arrays of all threads are deleted. No
 * routine may be running. */
void usub_end_job(void);
/** Does nothing; the cost of a call. */
int32_t usub_empty(usub_driver *driver);

/* end::cdef[] */

/** For stand-ins of functions that a routine calls and that exist in the commercial solver only:
 * leaves the routine with USUB_ROUTINE_STOPPED and a message with `name`. Does not return. */
void usub_missing_routine(const char *name);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#ifdef __cplusplus
}
#endif

#endif
