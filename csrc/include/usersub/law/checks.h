/* SPDX-License-Identifier: MIT */
/** @file law/checks.h
 * What a law asks of a scene (part of `laws.h`): a scene that gives too little ends the analysis
 * with a sentence.
 */
#ifndef USERSUB_LAW_CHECKS_H
#define USERSUB_LAW_CHECKS_H

#ifdef __cplusplus
extern "C" {
#endif

/* Utility routines of the solver: message, end of the analysis. */
void stdb_abqerr_(const int *level, const char *text, const int *ints, const double *reals,
                  const char *words, size_t text_length, size_t word_length);
void xplb_abqerr_(const int *level, const char *text, const int *ints, const usub_real *reals,
                  const char *words, size_t text_length, size_t word_length);
void xit_(void);
void xplb_exit_(void);

#ifdef __cplusplus
}
#endif

#define USUB_PROPS_TEXT(interface) USUB_LAW " behind " interface " needs %I properties, not %I"
#define USUB_STATES_TEXT(interface)                                                                \
  USUB_LAW " behind " interface " needs %I state variables, not %I"
#define USUB_MOST_TEXT                                                                             \
  USUB_LAW " has %I state variables, more than USUB_LAW_MOST, which was %I when the law was "      \
           "compiled"

#define USUB_ROOM_NEEDED(solver, props, count)                                                     \
  USUB_##solver##_NEEDS(                                                                           \
      usub_scalars(props, count) <= USUB_LAW_MOST && usub_vectors(props, count) <= USUB_LAW_MOST,  \
      USUB_MOST_TEXT, usub_scalars(props, count) + usub_vectors(props, count), USUB_LAW_MOST)

/* Ends an explicit analysis unless `holds`; `text` has two %I for the numbers. */
static inline int usub_explicit_needs(int holds, const char *text, size_t length, int first,
                                      int second) {
  const int level = -3, ints[2] = {first, second};
  const usub_real reals[1] = {0};
  if (holds)
    return 1;
  xplb_abqerr_(&level, text, ints, reals, "        ", length, 8);
  xplb_exit_();
  return 0;
}
#define USUB_EXPLICIT_NEEDS(holds, text, first, second)                                            \
  usub_explicit_needs(holds, text, sizeof(text) - 1, first, second)
#define USUB_EXPLICIT_PROPS(interface, props, count)                                               \
  USUB_EXPLICIT_NEEDS((count) >= usub_needed(props, count), USUB_PROPS_TEXT(interface),            \
                      usub_needed(props, count), count)

#ifndef USUB_SINGLE
/* Ends an implicit analysis unless `holds`. */
static inline int usub_standard_needs(int holds, const char *text, size_t length, int first,
                                      int second) {
  const int level = -3, ints[2] = {first, second};
  const double reals[1] = {0};
  if (holds)
    return 1;
  stdb_abqerr_(&level, text, ints, reals, "        ", length, 8);
  xit_();
  return 0;
}
#define USUB_STANDARD_NEEDS(holds, text, first, second)                                            \
  usub_standard_needs(holds, text, sizeof(text) - 1, first, second)
#define USUB_STANDARD_PROPS(interface, props, count)                                               \
  USUB_STANDARD_NEEDS((count) >= usub_needed(props, count), USUB_PROPS_TEXT(interface),            \
                      usub_needed(props, count), count)

#define USUB_TIME_TEXT USUB_LAW " behind FRIC needs a time increment above zero"
#ifdef USUB_LAW_READS_TIME
#define USUB_TIME_NEEDED(increment) USUB_STANDARD_NEEDS((increment) > 0, USUB_TIME_TEXT, 0, 0)
#else
#define USUB_TIME_NEEDED(increment) 1
#endif

/* What enforcement with an elastic slip takes, of which the state has one number a direction. */
#define USUB_ELASTIC_TEXT                                                                          \
  USUB_LAW " behind FRIC keeps its elastic slip in the first of %I state variables, not %I"
#define USUB_LENGTH_TEXT USUB_LAW " behind FRIC needs a characteristic length above zero"
#define USUB_ELASTIC_NEEDS(directions, props, count, given, allowable)                             \
  (USUB_ROOM_NEEDED(STANDARD, props, count) &&                                                     \
   USUB_STANDARD_NEEDS((given) >= (directions) + usub_scalars(props, count), USUB_ELASTIC_TEXT,    \
                       (directions) + usub_scalars(props, count), given) &&                        \
   USUB_STANDARD_NEEDS((allowable) > 0, USUB_LENGTH_TEXT, 0, 0))
#endif

/* A coefficient or strength that no friction has. */
#ifdef USUB_LAW_GIVES_STRESS
#define USUB_NEGATIVE_TEXT USUB_LAW " behind FRIC returns a strength below zero, or no number"
#else
#define USUB_NEGATIVE_TEXT USUB_LAW " behind FRIC returns a coefficient below zero, or no number"
#endif

#define USUB_OVERFLOW_TEXT USUB_LAW " behind FRIC: coefficient times pressure overflows"

/* State variables: `own` numbers of the law, the `given` ones of the scene; `solver` is EXPLICIT or
 * STANDARD. A law without state looks at neither. */
#ifdef USUB_LAW_FORGETS
#define USUB_STATES_NEEDED(solver, text, props, count, own, given) 1
#else
#define USUB_STATES_NEEDED(solver, text, props, count, own, given)                                 \
  (USUB_ROOM_NEEDED(solver, props, count) &&                                                       \
   USUB_##solver##_NEEDS((given) >= (own), text, own, given))
#endif

#endif
