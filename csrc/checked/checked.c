/* SPDX-License-Identifier: MIT */
/* A checked call of the routine. */
#include <link.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "checked.h"

/* The code around an address: the executable part of its library. */
typedef struct code_search {
  uintptr_t address;
  uintptr_t *code;
} code_search;

static int look_into(struct dl_phdr_info *info, size_t size, void *data) {
  (void)size;
  const code_search *search = data;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr) *part = &info->dlpi_phdr[i];
    const uintptr_t first = (uintptr_t)info->dlpi_addr + part->p_vaddr;
    if (part->p_type != PT_LOAD || !(part->p_flags & PF_X) || search->address < first ||
        search->address >= first + part->p_memsz)
      continue;
    search->code[0] = first;
    search->code[1] = first + part->p_memsz;
    return 1;
  }
  return 0;
}

static void find_code(const usub_driver *driver, usub_checker *checker) {
  code_search search = {0, checker->code};
  memcpy(&search.address, &driver->routine.entry, sizeof search.address);
  dl_iterate_phdr(look_into, &search);
}

/* The worker's memory, made at its first call. */
static usub_checker *checker_of(const usub_driver *driver, usub_call *call) {
  usub_checker *checker = call->checker;
  if (checker && checker->process == getpid())
    return checker;
  usub_checker *made = usub_checker_create(driver, call);
  if (!made)
    return NULL;
  if (checker)
    made->seen = checker->seen;
  find_code(driver, made);
  usub_checker_free(checker);
  call->checker = made;
  return made;
}

/* Keeps what went wrong in the call for the host. */
static void keep_failure(const usub_driver *driver, usub_checker *checker, const usub_call *call,
                         const usub_outcome *outcome) {
  usub_observed *seen = &checker->seen;
  const int32_t i = outcome->argument;
  seen->what = outcome->what;
  seen->argument = i;
  seen->element = i >= 0 ? outcome->element : -1;
  seen->access = outcome->access;
  seen->place = outcome->place;
  seen->status = outcome->status;
  seen->point = usub_point_of(driver, checker, i, outcome->element, call->n); /* of the call */
  seen->rank = 0;
  if (i >= 0 && outcome->element >= -((int64_t)1 << 40)) {
    seen->rank = checker->extents[i].rank;
    usub_index_of(&checker->extents[i], outcome->element, seen->index);
    if (outcome->access == USUB_ACCESS_READ)
      seen->read |= usub_bit(i);
    if (outcome->access == USUB_ACCESS_WRITE)
      seen->written |= usub_bit(i);
  }
  usub_outcome_text(driver, checker, outcome, seen->sentence, sizeof seen->sentence);
}

/* Outputs of the first pass, for the driver. */
static void give_answers(const usub_driver *driver, const usub_call *call,
                         const usub_checker *checker) {
  for (int32_t i = 0; i < checker->count; ++i) {
    const usub_room *room = &checker->rooms[i];
    if (room->writes && room->accessible && !usub_is_absent(driver, call, i))
      memcpy(call->argv[i], checker->kept + room->kept, checker->extents[i].bytes);
  }
}

/* What was written beside an argument in front of it: with the argument at the start of its pages
 * the instruction is caught. */
static void find_writer(const usub_driver *driver, usub_call *call, usub_checker *checker,
                        usub_outcome *outcome) {
  const usub_pass pass = {.lm = -1, .at_start = outcome->element < 0};
  usub_outcome found;
  usub_pass_run(driver, call, checker, &pass, &found);
  if (found.what == USUB_SAW_OUTSIDE && found.argument == outcome->argument &&
      found.access == USUB_ACCESS_WRITE)
    *outcome = found;
}

/* The passes; what is wrong is in `outcome`. */
static void run_passes(const usub_driver *driver, usub_call *call, usub_checker *checker,
                       usub_outcome *outcome) {
  const usub_pass first = {.speaks = 1, .lm = -1};
  usub_pass second = {.lm = -1, .at_start = 1, .garbage = 1, .poison = checker->outputs};
  usub_pass_run(driver, call, checker, &first, outcome);
  checker->seen.flags |= outcome->flags;
  if (outcome->what == USUB_SAW_RED_ZONE)
    find_writer(driver, call, checker, outcome);
  if (outcome->status < 0)
    return;
  usub_answers_keep(checker);
  usub_outcome other;
  usub_unwritten unwritten = {0};
  int differs = usub_pass_differs(driver, call, checker, outcome, &second, &other, &unwritten);
  usub_outcome again;
  if (differs && checker->zeroed && !usub_is_not_repeated(driver, call, checker, outcome, &again)) {
    /* Who reads the zeros that a host hands in does nothing wrong. */
    second.poison &= ~checker->zeroed;
    unwritten.arguments = 0;
    differs = usub_pass_differs(driver, call, checker, outcome, &second, &other, &unwritten);
  }
  if (differs) {
    usub_explain_difference(driver, call, checker, outcome, &second, &other);
    *outcome = other;
    return;
  }
  usub_judge_unwritten(driver, call, checker, &unwritten, outcome);
  if (!driver->tracing || outcome->what != USUB_SAW_NOTHING)
    return;
  const usub_pass traced = {.lm = -1, .closed = ~(uint64_t)0};
  usub_pass_run(driver, call, checker, &traced, &other);
  checker->seen.read |= other.read;
  checker->seen.written |= other.written;
}

int32_t usub_checked_call(const usub_driver *driver, usub_call *call) {
  usub_checker *checker = checker_of(driver, call);
  if (!checker)
    return USUB_NO_MEMORY;
  usub_rooms_lay(driver, call, checker);
  usub_outcome outcome;
  run_passes(driver, call, checker, &outcome);
  if (outcome.what != USUB_SAW_NOTHING) {
    keep_failure(driver, checker, call, &outcome);
    return outcome.status < 0 ? outcome.status : USUB_CONTRACT;
  }
  if (outcome.status < 0) {
    checker->seen.status = outcome.status;
    return outcome.status;
  }
  give_answers(driver, call, checker);
  return outcome.status;
}

int32_t usub_checked_fail(usub_driver *driver, usub_call *call, int32_t index, int32_t first,
                          int32_t status) {
  usub_checker *checker = call->checker;
  if (!checker && driver->checked)
    return usub_block_fail(driver, call, index, -1, status,
                           "%s: no memory for guarded pages; a checked call needs some for every "
                           "argument",
                           driver->title);
  if (!checker || checker->seen.what == USUB_SAW_NOTHING)
    return 0;
  usub_observed *seen = &checker->seen;
  const char *title = driver->title;
  /* What "of which there are 2" and "which is an input" end with. */
  const char *comma = strstr(seen->sentence, "which ") ? "," : "";
  seen->point = seen->point >= 0 ? first + usub_point_at(call, seen->point) : -1;
  if (seen->point >= 0)
    return usub_block_fail(driver, call, index, seen->point, status, "%s: %s%s at point %d", title,
                           seen->sentence, comma, seen->point);
  if (call->n == 0)
    return usub_block_fail(driver, call, index, -1, status, "%s: %s%s in a call without points",
                           title, seen->sentence, comma);
  return usub_block_fail(driver, call, index, -1, status, "%s: %s%s in points %d to %d", title,
                         seen->sentence, comma, first + usub_point_at(call, 0),
                         first + usub_point_at(call, call->n - 1));
}
