/* SPDX-License-Identifier: MIT */
/* The script of a run, and which points of it are written down.
 *
 * The scenario "plain" returns LM = 0 always. "multiplier" returns LM = 2 in every third increment
 * of six, LM = 1 in the fifth, and in the sixth LM = 1 for two iterations and then 0. "cut-back"
 * asks for half the increment in increments 2 and 5, or those of USERSUB_PROBE_CUT_BACK, once each.
 */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "probe.h"

enum { PLAIN, MULTIPLIER, CUT_BACK };
enum { TABLE = 1 << 14, REFUSED = 64 };

/* A contact point of FRIC or FRIC_COEF, and where it is in the analysis. */
typedef struct point {
  uint64_t hash;
  int32_t used, number, step, increment, iteration;
  double time, time_increment;
} point;

/* An increment that was asked to be shorter. */
typedef struct refusal {
  int32_t step, increment;
  double time, time_increment;
} refusal;

static pthread_once_t once = PTHREAD_ONCE_INIT;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static point *points;
static int32_t point_count, most_points = 8;
static refusal refusals[REFUSED];
static int32_t refusal_count, scenario;
static int32_t increments_to_refuse[8] = {2, 5};

static void read_settings(void) {
  points = calloc(TABLE, sizeof *points);
  const char *text = getenv("USERSUB_PROBE_SCENARIO");
  scenario = text && strcmp(text, "multiplier") == 0 ? MULTIPLIER
             : text && strcmp(text, "cut-back") == 0 ? CUT_BACK
                                                     : PLAIN;
  text = getenv("USERSUB_PROBE_POINTS");
  if (text && atoi(text) > 0)
    most_points = atoi(text);
  text = getenv("USERSUB_PROBE_CUT_BACK");
  if (!text || !text[0])
    return;
  memset(increments_to_refuse, 0, sizeof increments_to_refuse);
  for (int32_t i = 0; i < 8 && *text; ++i) {
    char *end;
    increments_to_refuse[i] = (int32_t)strtol(text, &end, 10);
    text = *end ? end + 1 : end;
  }
}

static uint64_t mixed(uint64_t hash, const void *data, size_t bytes) {
  const unsigned char *at = data;
  for (size_t i = 0; i < bytes; ++i)
    hash = (hash ^ at[i]) * 1099511628211u;
  return hash;
}

/* Names, element, integration point and node tell contact points apart. */
static uint64_t hash_of(const usub_probe_call *call) {
  static const int32_t fric[] = {USUB_FRIC_CINAME, USUB_FRIC_SECNAME, USUB_FRIC_MAINNAME,
                                 USUB_FRIC_NOEL,   USUB_FRIC_NPT,     USUB_FRIC_NODE};
  static const int32_t coefficient[] = {USUB_FRIC_COEF_2022_SURFINT, USUB_FRIC_COEF_2022_SURFSEC,
                                        USUB_FRIC_COEF_2022_SURFMAIN};
  const int is_fric = call->key == USUB_INTERFACE_FRIC;
  const size_t count =
      is_fric ? sizeof fric / sizeof *fric : sizeof coefficient / sizeof *coefficient;
  uint64_t hash = 14695981039346656037u;
  for (size_t i = 0; i < count; ++i) {
    const usub_probe_value *value = &call->value[is_fric ? fric[i] : coefficient[i]];
    if (value->data)
      hash = mixed(hash, value->data, value->readable);
  }
  if (!is_fric) {
    const int32_t node = usub_probe_int(call, USUB_FRIC_COEF_2022_IDATA, 3);
    hash = mixed(hash, &node, sizeof node);
  }
  return hash ? hash : 1;
}

/* The point of a call; NULL if the table is full. */
static point *point_of(const usub_probe_call *call) {
  const uint64_t hash = hash_of(call);
  for (size_t i = 0; points && i < TABLE; ++i) {
    point *at = &points[(hash + i) % TABLE];
    if (at->used && at->hash == hash)
      return at;
    if (at->used)
      continue;
    if (point_count >= TABLE / 2)
      return NULL;
    *at = (point){.hash = hash, .used = 1, .number = point_count++};
    return at;
  }
  return NULL;
}

/* Counts the iterations of a point in an attempt at an increment. */
static int32_t iteration_of(const usub_probe_call *call) {
  point *at = point_of(call);
  if (!at)
    return 1;
  const int32_t step = usub_probe_int(call, USUB_FRIC_KSTEP, 0);
  const int32_t increment = usub_probe_int(call, USUB_FRIC_KINC, 0);
  const double time = usub_probe_real(call, USUB_FRIC_TIME, 1);
  const double by = usub_probe_real(call, USUB_FRIC_DTIME, 0);
  const int same = at->step == step && at->increment == increment && at->time == time &&
                   at->time_increment == by;
  at->iteration = same ? at->iteration + 1 : 1;
  at->step = step;
  at->increment = increment;
  at->time = time;
  at->time_increment = by;
  return at->iteration;
}

/* Whether this attempt is to be refused: the first one at its increment is. */
static int refuses(const usub_probe_call *call) {
  const refusal now = {
      usub_probe_int(call, USUB_FRIC_KSTEP, 0), usub_probe_int(call, USUB_FRIC_KINC, 0),
      usub_probe_real(call, USUB_FRIC_TIME, 1), usub_probe_real(call, USUB_FRIC_DTIME, 0)};
  int wanted = 0;
  for (size_t i = 0; i < sizeof increments_to_refuse / sizeof *increments_to_refuse; ++i)
    wanted |= increments_to_refuse[i] != 0 && increments_to_refuse[i] == now.increment;
  if (!wanted || !(now.time_increment > 0))
    return 0;
  for (int32_t i = 0; i < refusal_count; ++i)
    if (refusals[i].step == now.step && refusals[i].increment == now.increment)
      return refusals[i].time == now.time && refusals[i].time_increment == now.time_increment;
  if (refusal_count == REFUSED)
    return 0;
  refusals[refusal_count++] = now;
  return 1;
}

usub_probe_script usub_probe_script_of(const usub_probe_call *call) {
  usub_probe_script script = {0, 0};
  if (call->key != USUB_INTERFACE_FRIC)
    return script;
  pthread_once(&once, read_settings);
  pthread_mutex_lock(&lock);
  const int32_t iteration = iteration_of(call);
  if (scenario == MULTIPLIER) {
    const int32_t turn = usub_probe_int(call, USUB_FRIC_KINC, 0) % 6;
    script.lm = turn == 3 ? 2 : turn == 5 || (turn == 0 && iteration <= 2) ? 1 : 0;
  }
  if (scenario == CUT_BACK)
    script.cut_back = refuses(call);
  pthread_mutex_unlock(&lock);
  return script;
}

int usub_probe_is_chosen(const usub_probe_call *call) {
  if (!call->face->standard)
    return 1;
  pthread_once(&once, read_settings);
  pthread_mutex_lock(&lock);
  const point *at = point_of(call);
  const int chosen = at && at->number < most_points;
  pthread_mutex_unlock(&lock);
  return chosen;
}
