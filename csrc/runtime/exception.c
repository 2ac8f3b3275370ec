/* SPDX-License-Identifier: MIT */
/* Exceptions that leave a routine, in C++ above all. Left alone, they end the process, or pass
 * through the driver to a host that catches them, and the guard stays armed for ever. So functions
 * that arm guards name a personality, as a C++ function with a `catch` does: it tells the unwinder
 * that the exception ends here, and leaves to the guard when everything above is cleaned up.
 * Nothing of C++ is linked: what is asked about an exception is found in the library that threw. */
#include "exception.h"

#if USUB_HAS_PERSONALITY

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <unwind.h>

#include "guard.h"
#include "usersub/status.h"

/** How std::type_info begins; the places of virtual functions are the same for all compilers. */
typedef struct type_info {
  void *const *functions;
  const char *name;
} type_info;
enum { DO_CATCH = 4, WHAT = 2 };

/* ISO C converts no pointer to data into one to a function. */
typedef union pointer {
  void *data;
  void *(*begin)(void *exception);
  void (*end)(void);
  const type_info *(*type)(void);
  char *(*demangle)(const char *name, char *buffer, size_t *size, int *status);
  _Bool (*do_catch)(const type_info *base, const type_info *type, void **object, unsigned outer);
  const char *(*what)(const void *object);
  void (*cleanup)(_Unwind_Reason_Code reason, struct _Unwind_Exception *exception);
} pointer;

static pointer look_up(void *library, const char *name) {
  return (pointer){.data = dlsym(library, name)};
}

/* The words of an object derived from std::exception, or NULL. */
static const char *words_of(void *library, const type_info *type, void *object) {
  const type_info *base = dlsym(library, "_ZTISt9exception");
  if (base == NULL)
    return NULL;
  const pointer do_catch = {.data = base->functions[DO_CATCH]};
  if (!do_catch.do_catch(base, type, &object, 1))
    return NULL;
  const pointer what = {.data = (*(void *const **)object)[WHAT]};
  return what.what(object);
}

static void describe(char *text, size_t size, void *library, const type_info *type, void *object) {
  const char *words = words_of(library, type, object);
  if (words != NULL) {
    snprintf(text, size, "an exception: %s", words);
    return;
  }
  const pointer demangle = look_up(library, "__cxa_demangle");
  char *plain = demangle.data ? demangle.demangle(type->name, NULL, NULL, &(int){0}) : NULL;
  snprintf(text, size, "an exception of type %s", plain ? plain : type->name);
  free(plain);
}

/* Ends an exception as a `catch` would, and says what it was. */
static void end_exception(char *text, size_t size, struct _Unwind_Exception *exception) {
  const uint64_t gnu_cpp = 0x474e5543432b2b00; /* "GNUCC++" */
  const pointer cleanup = {.cleanup = exception->exception_cleanup};
  Dl_info place;
  snprintf(text, size, "an exception");
  if (exception->exception_class != gnu_cpp || dladdr(cleanup.data, &place) == 0)
    return;
  void *library = dlopen(place.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
  if (library == NULL) /* its C++ library is linked into it */
    return;
  const pointer begin = look_up(library, "__cxa_begin_catch");
  const pointer end = look_up(library, "__cxa_end_catch");
  const pointer type = look_up(library, "__cxa_current_exception_type");
  if (begin.data && end.data && type.data) {
    begin.begin(exception);
    describe(text, size, library, type.type(), exception + 1); /* the object lies behind */
    end.end();
  }
  dlclose(library);
}

/** Called by the unwinder: first to find the frame where the exception ends, then to go there. */
__attribute__((used)) _Unwind_Reason_Code usub_personality(int version, _Unwind_Action actions,
                                                           _Unwind_Exception_Class class,
                                                           struct _Unwind_Exception *exception,
                                                           struct _Unwind_Context *context) {
  (void)class;
  (void)context;
  /* A thread that is cancelled unwinds as well, and has to go on. */
  if (version != 1 || (actions & _UA_FORCE_UNWIND) || !usub_guard_armed())
    return _URC_CONTINUE_UNWIND;
  if (actions & _UA_SEARCH_PHASE)
    return _URC_HANDLER_FOUND;
  if (!(actions & _UA_HANDLER_FRAME))
    return _URC_CONTINUE_UNWIND;
  char text[sizeof((usub_guard *)0)->reason];
  end_exception(text, sizeof text, exception);
  usub_guard_leave(USUB_ROUTINE_RAISED, "%s", text);
}

#endif
