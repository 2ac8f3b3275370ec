/* SPDX-License-Identifier: MIT */
/* Documented sizes of arguments, and what their elements are called. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "checked.h"

static int32_t position_of(const usub_interface *face, const char *name, size_t length) {
  for (int32_t i = 0; i < face->count; ++i) {
    const usub_arg *arg = &face->args[i];
    if ((strlen(arg->name) == length && strncmp(arg->name, name, length) == 0) ||
        (strlen(arg->modern) == length && strncmp(arg->modern, name, length) == 0))
      return i;
  }
  return -1;
}

/* "3", "nBlock" or "7+iData(5)", whose last part is the number of state variables. */
static usub_term read_term(const usub_driver *driver, const char *text, size_t length) {
  usub_term term = {-1, 0};
  if (text[0] >= '0' && text[0] <= '9') {
    term.constant = strtol(text, NULL, 10);
    if (memchr(text, '+', length))
      term.constant += driver->size.S;
    return term;
  }
  term.argument = position_of(driver->face, text, length);
  return term;
}

void usub_terms_read(const usub_driver *driver, usub_checker *checker) {
  for (int32_t i = 0; i < driver->face->count; ++i) {
    const usub_arg *arg = &driver->face->args[i];
    usub_extent *extent = &checker->extents[i];
    extent->element = arg->kind == USUB_KIND_CHAR  ? 1
                      : arg->kind == USUB_KIND_INT ? sizeof(int32_t)
                                                   : driver->size.real;
    extent->rank = 0;
    if (arg->kind == USUB_KIND_CHAR)
      checker->terms[i][extent->rank++] = (usub_term){-1, USUB_NAME_LENGTH};
    for (const char *at = arg->shape; *at && extent->rank < USUB_MAX_RANK;) {
      const size_t length = strcspn(at, ",");
      checker->terms[i][extent->rank++] = read_term(driver, at, length);
      at += length + (at[length] == ',');
    }
  }
}

usub_extent usub_extent_of(const usub_driver *driver, const usub_call *call,
                           const usub_checker *checker, int32_t argument, int32_t n) {
  usub_extent extent = checker->extents[argument];
  int64_t count = 1;
  for (int32_t k = 0; k < extent.rank; ++k) {
    const usub_term *term = &checker->terms[argument][k];
    int64_t value = term->constant;
    if (term->argument >= 0)
      value += driver->sources[term->argument].from == USUB_POINTS
                   ? n
                   : *(const int32_t *)call->argv[term->argument];
    extent.dims[k] = value;
    count *= value;
  }
  extent.bytes = (size_t)count * extent.element;
  return extent;
}

static int64_t floor_by(int64_t a, int64_t b) {
  return a / b - (a % b < 0);
}

void usub_index_of(const usub_extent *extent, int64_t element, int64_t index[USUB_MAX_RANK]) {
  for (int32_t k = 0; k < USUB_MAX_RANK; ++k)
    index[k] = 0;
  for (int32_t k = 0; k < extent->rank; ++k) {
    const int64_t dim = extent->dims[k];
    const int last = k == extent->rank - 1;
    if (last || dim <= 0) {
      index[k] = last ? element + 1 : 1;
      continue;
    }
    const int64_t above = floor_by(element, dim);
    index[k] = element - above * dim + 1;
    element = above;
  }
}

void usub_element_text(const usub_arg *arg, const usub_extent *extent, int64_t element, char *text,
                       size_t size) {
  int64_t index[USUB_MAX_RANK];
  if (extent->rank == 0) {
    if (element == 0)
      snprintf(text, size, "%s", arg->modern);
    else
      snprintf(text, size, "%s(%lld)", arg->modern, (long long)element + 1);
    return;
  }
  usub_index_of(extent, element, index);
  size_t at = (size_t)snprintf(text, size, "%s(", arg->modern);
  for (int32_t k = 0; k < extent->rank && at < size; ++k)
    at += (size_t)snprintf(text + at, size - at, "%s%lld", k ? "," : "", (long long)index[k]);
  if (at < size)
    snprintf(text + at, size - at, ")");
}

void usub_count_text(const usub_arg *arg, const usub_extent *extent, char *text, size_t size) {
  if (extent->rank == 0) {
    snprintf(text, size, "but %s is one number", arg->modern);
    return;
  }
  if (arg->kind == USUB_KIND_CHAR) {
    snprintf(text, size, "of which there are %d characters", USUB_NAME_LENGTH);
    return;
  }
  if (extent->bytes <= extent->element) {
    snprintf(text, size, extent->bytes ? "of which there is 1" : "of which there are none");
    return;
  }
  size_t at = (size_t)snprintf(text, size, "of which there are ");
  for (int32_t k = 0; k < extent->rank && at < size; ++k)
    at += (size_t)snprintf(text + at, size - at, "%s%lld", k ? " x " : "",
                           (long long)extent->dims[k]);
}

int32_t usub_point_of(const usub_driver *driver, const usub_checker *checker, int32_t argument,
                      int64_t element, int32_t n) {
  int64_t index[USUB_MAX_RANK];
  if (argument < 0)
    return n == 1 ? 0 : -1;
  const usub_extent *extent = &checker->extents[argument];
  usub_index_of(extent, element, index);
  for (int32_t k = 0; k < extent->rank; ++k) {
    const int32_t by = checker->terms[argument][k].argument;
    if (by >= 0 && driver->sources[by].from == USUB_POINTS && index[k] >= 1 && index[k] <= n)
      return (int32_t)index[k] - 1;
  }
  return n == 1 ? 0 : -1;
}

static const char *verb(int32_t access) {
  return access == USUB_ACCESS_WRITE ? "wrote" : access == USUB_ACCESS_READ ? "read" : "touched";
}

void usub_outcome_text(const usub_driver *driver, const usub_checker *checker,
                       const usub_outcome *outcome, char *text, size_t size) {
  char element[64] = "", count[96] = "";
  const int32_t i = outcome->argument;
  if (i >= 0) {
    const usub_arg *arg = &driver->face->args[i];
    usub_element_text(arg, &checker->extents[i], outcome->element, element, sizeof element);
    usub_count_text(arg, &checker->extents[i], count, sizeof count);
  }
  switch (outcome->what) {
  case USUB_SAW_OUTSIDE:
  case USUB_SAW_RED_ZONE:
    snprintf(text, size, "the routine %s %s, %s", verb(outcome->access), element, count);
    break;
  case USUB_SAW_INPUT_WRITTEN:
    snprintf(text, size, "the routine wrote %s, which is an input", element);
    break;
  case USUB_SAW_LEFT_OUT:
    snprintf(text, size, "the routine %s %s, which it is said not to use", verb(outcome->access),
             element);
    break;
  case USUB_SAW_NOT_WRITTEN:
    if (usub_interface_key(driver->face) == USUB_INTERFACE_FRIC && i == USUB_FRIC_LM)
      snprintf(text, size, "the routine did not set LM, whatever it was on entry");
    else
      snprintf(text, size, "the routine did not write %s%s", element,
               usub_interface_key(driver->face) == USUB_INTERFACE_FRIC ? " although LM = 0" : "");
    break;
  case USUB_SAW_TIME:
    snprintf(text, size, "the routine did not return within %g s", driver->time_limit);
    break;
  case USUB_SAW_STOP:
  case USUB_SAW_CRASH:
    snprintf(text, size, "the routine ended with %s", outcome->reason);
    break;
  default:
    snprintf(text, size, "%s", outcome->reason);
  }
}
