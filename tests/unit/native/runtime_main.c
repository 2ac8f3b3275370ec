/* SPDX-License-Identifier: MIT */
/* Calls SYMBOL of LIBRARY twice under a guard, and once more a function that returns, and prints a
 * line for each: status and reason. Arguments: LIBRARY SYMBOL [faults] [redirect] [thread] [bare]
 * [single]. */
#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "guard.h"
#include "redirect.h"

typedef void (*routine)(void);

static int single;

static void report(const char *what, routine call) {
  usub_guard guard;
  usub_guard_push(&guard);
  guard.single = single;
  if (sigsetjmp(guard.env, 0) == 0)
    call();
  printf("%s %d [%s] armed %d\n", what, (int)guard.status, guard.reason, usub_guard_armed());
  usub_guard_pop(&guard);
}

static void *twice(void *call) {
  routine entry;
  memcpy(&entry, &call, sizeof entry);
  report("first", entry);
  report("second", entry);
  return NULL;
}

static void show(void *context, int32_t level, const char *text) {
  (void)context;
  printf("message %d [%s]\n", (int)level, text);
}

static int given(int count, char **arguments, const char *word) {
  for (int i = 3; i < count; i++) {
    if (strcmp(arguments[i], word) == 0)
      return 1;
  }
  return 0;
}

int main(int count, char **arguments) {
  setvbuf(stdout, NULL, _IOLBF, 0);
  usub_set_message_handler(show, NULL);
  usub_publish_utilities();
  void *library = dlopen(arguments[1], RTLD_LAZY | RTLD_LOCAL);
  if (library == NULL) {
    printf("%s\n", dlerror());
    return 2;
  }
  if (given(count, arguments, "redirect"))
    printf("redirected %d\n", usub_redirect_stops(library) > 0);
  if (given(count, arguments, "faults"))
    usub_catch_faults(1);
  single = given(count, arguments, "single");
  void *entry = dlsym(library, arguments[2]);
  if (given(count, arguments, "bare")) {
    routine call;
    memcpy(&call, &entry, sizeof call);
    call();
  } else if (given(count, arguments, "thread")) {
    pthread_t thread;
    pthread_create(&thread, NULL, twice, entry);
    pthread_join(thread, NULL);
  } else {
    twice(entry);
  }
  void *fine = dlsym(library, "fine");
  twice(fine);
  usub_catch_faults(0);
  puts("alive");
  return 0;
}
