/* SPDX-License-Identifier: MIT */
/* Scenes: settings by key, refused here already if key, kind or choice is wrong. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

typedef enum { IS_INT, IS_REAL, IS_TEXT } setting_kind;

typedef struct setting_row {
  const char *key;
  setting_kind kind;
  size_t offset;
  const char *choices;
} setting_row;

static const setting_row rows[] = {
#define SETTING_INT(key, value, meaning) {#key, IS_INT, offsetof(usub_settings, key), ""},
#define SETTING_REAL(key, value, meaning) {#key, IS_REAL, offsetof(usub_settings, key), ""},
#define SETTING_TEXT(key, value, choices, meaning)                                                 \
  {#key, IS_TEXT, offsetof(usub_settings, key), choices},
#include "settings.inc"
#undef SETTING_INT
#undef SETTING_REAL
#undef SETTING_TEXT
};

static const usub_settings defaults = {
#define SETTING_INT(key, value, meaning) .key = value,
#define SETTING_REAL(key, value, meaning) .key = value,
#define SETTING_TEXT(key, value, choices, meaning) .key = value,
#include "settings.inc"
#undef SETTING_INT
#undef SETTING_REAL
#undef SETTING_TEXT
};

static const char *const kind_names[] = {"an integer", "a real number", "a text"};

static int32_t refuse(usub_scene *scene, const char *format, ...) {
  va_list list;
  va_start(list, format);
  vsnprintf(scene->message, sizeof scene->message, format, list);
  va_end(list);
  return USUB_BAD_ARGUMENT;
}

/* The field of `key`, or NULL with a message if there is none of that kind. */
static void *field(usub_scene *scene, const char *key, setting_kind kind, const setting_row **row) {
  scene->message[0] = 0;
  for (size_t i = 0; key && i < sizeof rows / sizeof rows[0]; ++i) {
    if (strcmp(rows[i].key, key) != 0)
      continue;
    if (rows[i].kind != kind) {
      refuse(scene, "scene setting '%s' is %s, not %s", key, kind_names[rows[i].kind],
             kind_names[kind]);
      return NULL;
    }
    if (row)
      *row = &rows[i];
    return (char *)&scene->settings + rows[i].offset;
  }
  size_t used =
      (size_t)snprintf(scene->message, sizeof scene->message,
                       "no scene setting is called '%s'; settings:", key ? key : "(null)");
  for (size_t i = 0; i < sizeof rows / sizeof rows[0] && used < sizeof scene->message; ++i)
    used += (size_t)snprintf(scene->message + used, sizeof scene->message - used, "%s %s",
                             i ? "," : "", rows[i].key);
  return NULL;
}

int32_t usub_scene_create(usub_scene **scene) {
  if (!scene)
    return USUB_BAD_ARGUMENT;
  *scene = calloc(1, sizeof **scene);
  if (!*scene)
    return USUB_NO_MEMORY;
  (*scene)->settings = defaults;
  return USUB_OK;
}

void usub_scene_free(usub_scene *scene) {
  if (!scene)
    return;
  free(scene->props);
  free(scene);
}

const char *usub_scene_message(const usub_scene *scene) {
  return scene ? scene->message : "";
}

int32_t usub_scene_set_int(usub_scene *scene, const char *key, int32_t value) {
  if (!scene)
    return USUB_BAD_ARGUMENT;
  int32_t *target = field(scene, key, IS_INT, NULL);
  if (!target)
    return USUB_BAD_ARGUMENT;
  if (value < 0)
    return refuse(scene, "scene setting '%s' = %d; expected 0 or more", key, value);
  *target = value;
  return USUB_OK;
}

int32_t usub_scene_set_real(usub_scene *scene, const char *key, double value) {
  if (!scene)
    return USUB_BAD_ARGUMENT;
  double *target = field(scene, key, IS_REAL, NULL);
  if (!target)
    return USUB_BAD_ARGUMENT;
  if (!(value >= 0) || !isfinite(value))
    return refuse(scene, "scene setting '%s' = %g; expected a finite value of 0 or more", key,
                  value);
  *target = value;
  return USUB_OK;
}

/* Whether `value` is one of `choices`, which are separated by bars. */
static int is_choice(const char *choices, const char *value) {
  size_t length = strlen(value);
  for (const char *at = choices; *at;) {
    size_t word = strcspn(at, "|");
    if (word == length && strncmp(at, value, word) == 0)
      return 1;
    at += word + (at[word] == '|');
  }
  return 0;
}

int32_t usub_scene_set_text(usub_scene *scene, const char *key, const char *value) {
  if (!scene)
    return USUB_BAD_ARGUMENT;
  const setting_row *row = NULL;
  char *target = field(scene, key, IS_TEXT, &row);
  if (!target)
    return USUB_BAD_ARGUMENT;
  if (!value || strlen(value) >= USUB_TEXT_LENGTH)
    return refuse(scene, "scene setting '%s' is %s; expected a text of at most %d characters", key,
                  value ? "too long" : "NULL", USUB_TEXT_LENGTH - 1);
  if (row->choices[0] && !is_choice(row->choices, value))
    return refuse(scene, "scene setting '%s' = '%s'; expected one of %s", key, value, row->choices);
  strcpy(target, value);
  return USUB_OK;
}

int32_t usub_scene_set_props(usub_scene *scene, const double *props, int32_t count) {
  if (!scene)
    return USUB_BAD_ARGUMENT;
  scene->message[0] = 0;
  if (count < 0 || (count > 0 && !props))
    return refuse(scene, "props: %d values%s; expected 0 or more", count, props ? "" : " at NULL");
  for (int32_t i = 0; i < count; ++i)
    if (isnan(props[i]))
      return refuse(scene, "props[%d] is NaN", i);
  double *copy = NULL;
  if (count) {
    copy = malloc((size_t)count * sizeof *copy);
    if (!copy)
      return USUB_NO_MEMORY;
    memcpy(copy, props, (size_t)count * sizeof *copy);
  }
  free(scene->props);
  scene->props = copy;
  scene->prop_count = count;
  return USUB_OK;
}
