/* SPDX-License-Identifier: MIT */
/* Two threads in one routine, where it hurts most: right behind a write to data that its library
 * keeps (COMMON, SAVE, static), the other thread makes its whole call.
 *
 * These data are made read-only; the fault of a write opens them for one instruction (trap flag),
 * and the trap behind it is where the first thread waits. */
#include <errno.h>
#include <link.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include "../runtime/thread.h"
#include "checked.h"

#if defined(__linux__) && defined(__x86_64__)
#include <ucontext.h>

enum { TRAP_FLAG = 0x100, STACK_BYTES = 64 << 20, PATIENCE_NS = 250000000 };

typedef struct encounter {
  uintptr_t entry;       /* of the routine */
  uintptr_t code[2];     /* its code */
  uintptr_t first, last; /* data of its library */
  uintptr_t links[2];    /* of these, what the loader writes */
  uintptr_t low, high;   /* their pages */
  int32_t turn, writes;  /* the write that is waited for; those so far */
  int counts, steps, met;
  uint64_t place, address;
  usub_driver *other;
  int32_t status; /* of the other's call */
  sem_t begin, end;
} encounter;

static _Thread_local encounter *mine __attribute__((tls_model("initial-exec")));

/* The table of addresses that the loader fills in when a function is called for the first time. */
static void find_links(const struct dl_phdr_info *info, const ElfW(Dyn) * at, encounter *here) {
  size_t relocations = 0;
  for (; at->d_tag != DT_NULL; ++at) {
    if (at->d_tag == DT_PLTGOT) /* relocated by some loaders, not by others */
      here->links[0] =
          at->d_un.d_ptr < info->dlpi_addr ? info->dlpi_addr + at->d_un.d_ptr : at->d_un.d_ptr;
    if (at->d_tag == DT_PLTRELSZ)
      relocations = at->d_un.d_val / sizeof(ElfW(Rela));
  }
  here->links[1] = here->links[0] + (3 + relocations) * sizeof(void *);
}

static int look_into(struct dl_phdr_info *info, size_t size, void *data) {
  (void)size;
  encounter *here = data;
  const uintptr_t base = (uintptr_t)info->dlpi_addr;
  uintptr_t fixed = 0, data_first = 0, data_last = 0;
  const ElfW(Dyn) *dynamic = NULL;
  int found = 0;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr) *part = &info->dlpi_phdr[i];
    const uintptr_t first = base + part->p_vaddr, last = first + part->p_memsz;
    if (part->p_type == PT_LOAD && here->entry >= first && here->entry < last) {
      found = 1;
      here->code[0] = first;
      here->code[1] = last;
    }
    if (part->p_type == PT_LOAD && (part->p_flags & PF_W)) {
      data_first = first;
      data_last = last;
    }
    if (part->p_type == PT_GNU_RELRO)
      fixed = last;
    if (part->p_type == PT_DYNAMIC)
      dynamic = (const ElfW(Dyn) *)first;
  }
  if (!found)
    return 0;
  if (info->dlpi_name && info->dlpi_name[0]) { /* not the program itself, which has other threads */
    const uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE);
    fixed = (fixed + page - 1) / page * page;
    here->first = data_first > fixed ? data_first : fixed;
    here->last = data_last;
    here->low = here->first / page * page;
    here->high = (data_last + page - 1) / page * page;
    if (dynamic)
      find_links(info, dynamic, here);
  }
  return 1;
}

static void protect(const encounter *here, int how) {
  mprotect((void *)here->low, here->high - here->low, how);
}

/* A fault of the first thread. */
static int open_data(void *context, uintptr_t address, int32_t access, void *machine) {
  encounter *here = context;
  greg_t *registers = ((ucontext_t *)machine)->uc_mcontext.gregs;
  if (access != USUB_ACCESS_WRITE || here->met || address < here->low || address >= here->high)
    return 0;
  protect(here, PROT_READ | PROT_WRITE);
  here->counts = address >= here->first && address < here->last &&
                 !(address >= here->links[0] && address < here->links[1]);
  if (here->counts && ++here->writes == here->turn) {
    here->address = address;
    here->place = usub_place_in(here->code, (uintptr_t)registers[REG_RIP]);
  }
  here->steps = 1;
  registers[REG_EFL] |= TRAP_FLAG;
  return 1;
}

/* Lets the other thread make its call; one that waits for a lock of this one is not waited for. */
static void let_other(encounter *here) {
  struct timespec until;
  clock_gettime(CLOCK_REALTIME, &until);
  until.tv_nsec += PATIENCE_NS;
  until.tv_sec += until.tv_nsec / 1000000000;
  until.tv_nsec %= 1000000000;
  here->met = 1;
  sem_post(&here->begin);
  while (sem_timedwait(&here->end, &until) != 0 && errno == EINTR) {
  }
}

/* Behind the write. */
static void trapped(int number, siginfo_t *info, void *machine) {
  (void)number;
  (void)info;
  encounter *here = mine;
  if (!here || !here->steps)
    return;
  here->steps = 0;
  ((ucontext_t *)machine)->uc_mcontext.gregs[REG_EFL] &= ~(greg_t)TRAP_FLAG;
  if (here->counts && here->writes == here->turn)
    let_other(here);
  else
    protect(here, PROT_READ);
}

static int32_t call_of(usub_driver *driver) {
  if (driver->kind == USUB_KIND_OF_STANDARD)
    return usub_iterate(driver);
  return driver->kind == USUB_KIND_OF_EXPLICIT ? usub_step(driver) : usub_evaluate(driver);
}

static void *live(void *context) {
  encounter *here = context;
  while (sem_wait(&here->begin) != 0) {
  }
  here->status = call_of(here->other);
  sem_post(&here->end);
  return NULL;
}

static int start(pthread_t *thread, encounter *here) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, STACK_BYTES);
  const int failed = pthread_create(thread, &attributes, live, here);
  pthread_attr_destroy(&attributes);
  return failed;
}

/* The call of the first thread, with the data closed. */
static int32_t call_watched(usub_driver *one, encounter *here) {
  usub_thread *thread = &usub_this_thread;
  struct sigaction action = {.sa_sigaction = trapped,
                             .sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER};
  struct sigaction before;
  sigaction(SIGTRAP, &action, &before);
  mine = here;
  thread->mend_context = here;
  thread->mend = open_data;
  protect(here, PROT_READ);
  const int32_t status = call_of(one);
  thread->mend = NULL;
  mine = NULL;
  protect(here, PROT_READ | PROT_WRITE);
  sigaction(SIGTRAP, &before, NULL);
  return status;
}

int32_t usub_meet(usub_driver *one, usub_driver *two, int32_t turn, usub_meeting *meeting) {
  if (!one || !two || one == two || !meeting || turn < 1)
    return USUB_BAD_ARGUMENT;
  memset(meeting, 0, sizeof *meeting);
  encounter here = {.turn = turn, .other = two};
  memcpy(&here.entry, &one->routine.entry, sizeof here.entry);
  dl_iterate_phdr(look_into, &here);
  if (here.high <= here.low || one->checked || two->checked || one->pool || two->pool)
    return usub_fail(one, USUB_NOT_SUPPORTED,
                     "%s: two threads meet in drivers that are neither checked nor have threads, "
                     "of a routine in a library that keeps data",
                     one->title);
  pthread_t thread;
  sem_init(&here.begin, 0, 0);
  sem_init(&here.end, 0, 0);
  usub_catch_faults(1);
  const int failed = start(&thread, &here);
  if (!failed) {
    meeting->status_one = call_watched(one, &here);
    if (!here.met)
      sem_post(&here.begin);
    pthread_join(thread, NULL);
  }
  sem_destroy(&here.begin);
  sem_destroy(&here.end);
  if (failed)
    return usub_fail(one, USUB_NO_MEMORY, "%s: no second thread", one->title);
  meeting->status_two = here.status;
  meeting->met = here.met;
  meeting->place = here.place;
  meeting->address = here.address;
  return USUB_OK;
}

#else

int32_t usub_meet(usub_driver *one, usub_driver *two, int32_t turn, usub_meeting *meeting) {
  if (!one || !two || one == two || !meeting || turn < 1)
    return USUB_BAD_ARGUMENT;
  memset(meeting, 0, sizeof *meeting);
  return usub_fail(one, USUB_NOT_SUPPORTED, "%s: two threads meet in Linux on x86-64 only",
                   one->title);
}

#endif
