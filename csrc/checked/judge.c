/* SPDX-License-Identifier: MIT */
/* What the passes say about each other. */
#include <stdio.h>
#include <string.h>

#include "../driver/fric_coef.h"
#include "checked.h"

static const usub_pass plain = {.lm = -1};

void usub_answers_keep(usub_checker *checker) {
  for (int32_t i = 0; i < checker->count; ++i) {
    const usub_room *room = &checker->rooms[i];
    if (room->writes)
      memcpy(checker->kept + room->kept, room->open + room->offset, room->filled);
  }
}

/* The number of an element, for people. */
static double value_of(const usub_driver *driver, int32_t argument, const char *element) {
  if (driver->face->args[argument].kind == USUB_KIND_INT)
    return (double)*(const int32_t *)(const void *)element;
  return driver->single ? (double)*(const float *)(const void *)element
                        : *(const double *)(const void *)element;
}

static void note_unwritten(usub_unwritten *unwritten, int32_t argument, int64_t element) {
  if (!(unwritten->arguments & usub_bit(argument)))
    unwritten->first[argument] = element;
  unwritten->arguments |= usub_bit(argument);
}

/* Element of one argument that differs, -1 if none does. */
static int64_t first_difference(const usub_call *call, const usub_checker *checker, int32_t i,
                                int poisoned, usub_unwritten *unwritten) {
  const usub_room *room = &checker->rooms[i];
  const usub_extent *extent = &checker->extents[i];
  const char *now = room->open + room->offset, *first = checker->kept + room->kept;
  const size_t size = extent->element;
  if (!poisoned && memcmp(now, first, room->filled) == 0)
    return -1;
  for (size_t at = 0; at < room->filled; at += size) {
    const int same = memcmp(now + at, first + at, size) == 0;
    if (poisoned && usub_is_poison(extent, now + at) &&
        memcmp(first + at, (const char *)call->argv[i] + at, size) == 0)
      note_unwritten(unwritten, i, (int64_t)(at / size));
    else if (!same)
      return (int64_t)(at / size);
  }
  return -1;
}

int usub_answers_differ(const usub_call *call, const usub_checker *checker, const usub_pass *pass,
                        usub_outcome *outcome, usub_unwritten *unwritten) {
  for (int32_t i = 0; i < checker->count; ++i) {
    if (!checker->rooms[i].writes)
      continue;
    const int poisoned = (pass->poison & usub_bit(i)) != 0;
    const int64_t element = first_difference(call, checker, i, poisoned, unwritten);
    if (element < 0)
      continue;
    outcome->argument = i;
    outcome->element = element;
    return 1;
  }
  return 0;
}

int usub_pass_differs(const usub_driver *driver, usub_call *call, usub_checker *checker,
                      const usub_outcome *first, const usub_pass *pass, usub_outcome *outcome,
                      usub_unwritten *unwritten) {
  usub_pass_run(driver, call, checker, pass, outcome);
  return outcome->status != first->status ||
         usub_answers_differ(call, checker, pass, outcome, unwritten);
}

/* The same where nobody asks what was not written. */
static int is_other(const usub_driver *driver, usub_call *call, usub_checker *checker,
                    const usub_pass *pass, const usub_outcome *first, usub_outcome *outcome) {
  usub_unwritten unwritten = {0};
  return usub_pass_differs(driver, call, checker, first, pass, outcome, &unwritten);
}

/* "gave TAU(1) = 2 instead of 1", or how the pass ended. */
static void describe(const usub_driver *driver, const usub_checker *checker,
                     const usub_outcome *outcome, char *text, size_t size) {
  if (outcome->argument < 0 || outcome->what != USUB_SAW_NOTHING) {
    char sentence[224];
    usub_outcome_text(driver, checker, outcome, sentence, sizeof sentence);
    snprintf(text, size, "ended so: %s", sentence);
    return;
  }
  const usub_room *room = &checker->rooms[outcome->argument];
  const usub_extent *extent = &checker->extents[outcome->argument];
  const size_t at = (size_t)outcome->element * extent->element;
  char element[64];
  usub_element_text(&driver->face->args[outcome->argument], extent, outcome->element, element,
                    sizeof element);
  snprintf(text, size, "gave %s = %.9g instead of %.9g", element,
           value_of(driver, outcome->argument, room->open + room->offset + at),
           value_of(driver, outcome->argument, checker->kept + room->kept + at));
}

static void conclude(usub_outcome *other, const usub_outcome *found, int32_t what,
                     const char *reason) {
  const uint64_t place = found->place;
  const int32_t argument = found->argument;
  const int64_t element = found->element;
  memset(other, 0, sizeof *other);
  other->what = what;
  other->status = USUB_CONTRACT;
  other->argument = argument;
  other->element = element;
  other->place = place;
  snprintf(other->reason, sizeof other->reason, "%s", reason);
}

/* Two calls in a row, since what is kept inside may have a period of two. */
int usub_is_not_repeated(const usub_driver *driver, usub_call *call, usub_checker *checker,
                         const usub_outcome *first, usub_outcome *other) {
  usub_outcome again;
  char how[256], reason[400];
  for (int turn = 0; turn < 2; ++turn) {
    if (!is_other(driver, call, checker, &plain, first, &again))
      continue;
    describe(driver, checker, &again, how, sizeof how);
    snprintf(reason, sizeof reason, "a second call with the same input %s", how);
    conclude(other, &again, USUB_SAW_NOT_REPEATED, reason);
    return 1;
  }
  return 0;
}

/* An output is read before it is written: which one? */
static int output_read(const usub_driver *driver, usub_call *call, usub_checker *checker,
                       const usub_outcome *first, usub_outcome *other) {
  usub_outcome found;
  char how[256], reason[400];
  for (int32_t i = 0; i < checker->count; ++i) {
    const usub_pass pass = {.lm = -1, .poison = usub_bit(i)};
    if (!(checker->outputs & ~checker->zeroed & usub_bit(i)) || !checker->rooms[i].accessible)
      continue;
    if (!is_other(driver, call, checker, &pass, first, &found))
      continue;
    describe(driver, checker, &found, how, sizeof how);
    snprintf(reason, sizeof reason,
             "the routine read %s before it wrote it: a call that began with other numbers there "
             "%s",
             driver->face->args[i].modern, how);
    if (found.argument != i)
      found.element = -1;
    found.argument = i;
    conclude(other, &found, USUB_SAW_OUTPUT_READ, reason);
    other->access = USUB_ACCESS_READ;
    return 1;
  }
  return 0;
}

static int uninitialised(const usub_driver *driver, usub_call *call, usub_checker *checker,
                         const usub_outcome *first, usub_outcome *other) {
  const usub_pass pass = {.lm = -1, .garbage = 1};
  usub_outcome found;
  char how[256], reason[400];
  if (!is_other(driver, call, checker, &pass, first, &found))
    return 0;
  describe(driver, checker, &found, how, sizeof how);
  snprintf(reason, sizeof reason,
           "the routine read a local variable that it had not set: a call with other garbage on "
           "the stack %s",
           how);
  conclude(other, &found, USUB_SAW_UNINITIALISED, reason);
  return 1;
}

void usub_explain_difference(const usub_driver *driver, usub_call *call, usub_checker *checker,
                             const usub_outcome *first, const usub_pass *pass,
                             usub_outcome *other) {
  char how[256], reason[400];
  const usub_outcome second = *other;
  describe(driver, checker, other, how, sizeof how);
  if (usub_is_not_repeated(driver, call, checker, first, other) ||
      output_read(driver, call, checker, first, other) ||
      uninitialised(driver, call, checker, first, other))
    return;
  *other = second;
  if (second.what != USUB_SAW_NOTHING)
    return; /* the second pass says itself what is wrong */
  const usub_pass moved = {.lm = -1, .at_start = pass->at_start};
  usub_outcome found;
  const int depends = is_other(driver, call, checker, &moved, first, &found);
  snprintf(reason, sizeof reason, "a second call with the same input %s%s", how,
           depends ? ": the answer depends on what lies beside the arguments" : "");
  conclude(other, &second, USUB_SAW_NOT_REPEATED, reason);
}

/* FRIC: whether the routine leaves LM as it is, whatever it is on entry, without writing it. Some
 * rightly return at once where a point was open, so that one value alone says nothing. */
static int lm_is_never_set(const usub_driver *driver, usub_call *call, usub_checker *checker) {
  for (int32_t lm = 0; lm < 3; ++lm) {
    const usub_pass pass = {.lm = lm, .closed = usub_bit(USUB_FRIC_LM)};
    usub_outcome outcome;
    usub_pass_run(driver, call, checker, &pass, &outcome);
    if (outcome.status != USUB_OK || (outcome.written & usub_bit(USUB_FRIC_LM)))
      return 0;
  }
  return 1;
}

/* FRIC: arguments that a host reads after the call as the routine left them. */
static void judge_fric(const usub_driver *driver, usub_call *call, usub_checker *checker,
                       usub_unwritten *unwritten, uint64_t *required) {
  const usub_room *room = &checker->rooms[USUB_FRIC_LM];
  const usub_pass pass = {.lm = -1, .closed = usub_bit(USUB_FRIC_LM) | usub_bit(USUB_FRIC_TAU)};
  int32_t lm = 0;
  usub_outcome outcome;
  usub_pass_run(driver, call, checker, &pass, &outcome);
  for (int32_t i = USUB_FRIC_LM; i <= USUB_FRIC_TAU; ++i)
    if (outcome.status == USUB_OK && !(outcome.written & usub_bit(i)))
      note_unwritten(unwritten, i, 0);
  /* A Python function that knows only TAU: the driver takes LM for 0. */
  const int unknown =
      usub_used(driver, USUB_FRIC_LM) == 0 && driver->routine.style != USUB_STYLE_FULL;
  if (!unknown)
    memcpy(&lm, checker->kept + room->kept, sizeof lm);
  if (!unknown && (unwritten->arguments & usub_bit(USUB_FRIC_LM)) &&
      lm_is_never_set(driver, call, checker))
    *required |= usub_bit(USUB_FRIC_LM);
  if (lm == 0)
    *required |= usub_bit(USUB_FRIC_DDTDDG) | usub_bit(USUB_FRIC_DDTDDP);
}

void usub_judge_unwritten(const usub_driver *driver, usub_call *call, usub_checker *checker,
                          usub_unwritten *unwritten, usub_outcome *outcome) {
  const int coefficient = strstr(driver->face->name, "_coef") != NULL;
  uint64_t required = coefficient ? usub_bit(USUB_COEF) : 0;
  if (usub_interface_key(driver->face) == USUB_INTERFACE_FRIC)
    judge_fric(driver, call, checker, unwritten, &required);
  for (int32_t i = 0; i < checker->count; ++i) {
    if (usub_is_left_out(driver, i) && ((checker->outputs | required) & usub_bit(i))) {
      note_unwritten(unwritten, i, 0);
      /* A Python function need not name every output: those that it leaves out are zero. */
      if (driver->routine.style != USUB_STYLE_FULL)
        required &= ~usub_bit(i);
    }
    if (!(unwritten->arguments & usub_bit(i)))
      continue;
    const int64_t element = unwritten->first[i];
    /* A second coefficient is for anisotropic friction alone; so are its derivatives. */
    if (coefficient && i == USUB_COEF &&
        element >= (int64_t)call->n * (1 + driver->set.anisotropic))
      continue;
    if (coefficient && i == USUB_DERIV && element >= (int64_t)call->n * USUB_LEGACY_DERIVATIVES)
      continue;
    checker->seen.unwritten |= usub_bit(i);
    if (!(required & usub_bit(i)) || outcome->what != USUB_SAW_NOTHING)
      continue;
    outcome->what = USUB_SAW_NOT_WRITTEN;
    outcome->status = USUB_CONTRACT;
    outcome->argument = i;
    outcome->element = element;
  }
}
