/* SPDX-License-Identifier: MIT */
/* What routines say, and what they are told about the job. The only settings of the process. */
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "thread.h"
#include "usersub/usersub.h"

static struct {
  pthread_mutex_t lock;
  usub_message_fn handler;
  void *context;
  char name[257], folder[257];
} job = {.lock = PTHREAD_MUTEX_INITIALIZER, .name = "usersub", .folder = "."};

void usub_set_message_handler(usub_message_fn handler, void *context) {
  pthread_mutex_lock(&job.lock);
  job.handler = handler;
  job.context = context;
  pthread_mutex_unlock(&job.lock);
}

int usub_say(int32_t level, const char *format, ...) {
  if (usub_this_thread.muted)
    return 1;
  /* The handler runs outside of the lock: it may itself wait for a thread that sets a handler. */
  pthread_mutex_lock(&job.lock);
  usub_message_fn handler = job.handler;
  void *context = job.context;
  pthread_mutex_unlock(&job.lock);
  if (handler == NULL)
    return 0;
  char text[4096];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  handler(context, level, text);
  return 1;
}

int32_t usub_set_job(const char *job_name, const char *output_folder) {
  if (job_name == NULL || output_folder == NULL || strlen(job_name) >= sizeof job.name ||
      strlen(output_folder) >= sizeof job.folder)
    return USUB_BAD_ARGUMENT;
  pthread_mutex_lock(&job.lock);
  strcpy(job.name, job_name);
  strcpy(job.folder, output_folder);
  pthread_mutex_unlock(&job.lock);
  return USUB_OK;
}

static void copy(char *text, size_t size, const char *from) {
  pthread_mutex_lock(&job.lock);
  snprintf(text, size, "%s", from);
  pthread_mutex_unlock(&job.lock);
}

void usub_job_name(char *text, size_t size) {
  copy(text, size, job.name);
}
void usub_job_folder(char *text, size_t size) {
  copy(text, size, job.folder);
}
