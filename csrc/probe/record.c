/* SPDX-License-Identifier: MIT */
/* The record: a file that the checker made, a page of counters and behind it one entry a call. */
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "probe.h"

#define HEAD 4096
#define ENTRY_MARK 0x42505355u /* "USPB" */

/* First page of the file, shared by all processes of the host, so that the numbers outlive them. */
typedef struct head {
  char magic[8]; /* "USUBPROB" */
  int32_t version, reserved;
  char abi_hash[24];
  int64_t most_calls, most_bytes;          /* set by the checker */
  atomic_llong calls, kept, bytes, latest; /* latest: nanoseconds of the clock at the last call */
} head;

/* One call; numbers of the machine, no padding. */
typedef struct entry_head {
  uint32_t mark, version;
  uint64_t size; /* bytes of the whole entry */
  int64_t sequence, begin, end;
  uint64_t lengths[3];
  int32_t process, thread, key, single, precision_basis, generation_basis, arguments, reserved;
} entry_head;

/* One argument; behind it the bytes on entry and the answer, each filled up to eight. */
typedef struct entry_argument {
  uint64_t address;
  int64_t count;
  uint64_t bytes, readable, kept, answered;
  int32_t found, refused;
} entry_argument;

_Static_assert(sizeof(entry_head) == 96, "the reader in Python knows this layout");
_Static_assert(sizeof(entry_argument) == 56, "the reader in Python knows this layout");

static pthread_once_t once = PTHREAD_ONCE_INIT;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static head *shared;
static int file = -1;
static atomic_llong calls_without_record;

static void open_record(void) {
  const char *path = getenv("USERSUB_PROBE_LOG");
  if (!path || !path[0])
    return;
  const int opened = open(path, O_RDWR | O_APPEND | O_CLOEXEC);
  struct stat about;
  if (opened < 0 || fstat(opened, &about) < 0 || about.st_size < HEAD) {
    if (opened >= 0)
      close(opened);
    return;
  }
  head *found = mmap(NULL, HEAD, PROT_READ | PROT_WRITE, MAP_SHARED, opened, 0);
  if (found == MAP_FAILED || memcmp(found->magic, "USUBPROB", 8) != 0 ||
      found->version != USUB_PROBE_VERSION) {
    close(opened);
    return;
  }
  memcpy(found->abi_hash, USUB_ABI_HASH, sizeof USUB_ABI_HASH);
  file = opened;
  shared = found;
}

int usub_probe_is_recording(void) {
  pthread_once(&once, open_record);
  return shared != NULL;
}

int64_t usub_probe_next_call(void) {
  if (!usub_probe_is_recording())
    return atomic_fetch_add(&calls_without_record, 1) + 1;
  return atomic_fetch_add(&shared->calls, 1) + 1;
}

static size_t filled(size_t bytes) {
  return (bytes + 7) / 8 * 8;
}

static size_t kept_of(size_t bytes) {
  return bytes < USUB_PROBE_KEPT ? bytes : USUB_PROBE_KEPT;
}

static size_t put(char *to, const void *from, size_t bytes) {
  memcpy(to, from, bytes);
  return filled(bytes);
}

static size_t size_of(const usub_probe_call *call) {
  size_t size = sizeof(entry_head);
  for (int32_t i = 0; i < call->face->count; ++i) {
    const usub_probe_value *value = &call->value[i];
    const size_t kept = value->data ? kept_of(value->readable) : 0;
    size += sizeof(entry_argument) + filled(kept) + (value->answer ? filled(kept) : 0);
  }
  return size;
}

static void fill(const usub_probe_call *call, char *entry, size_t size) {
  entry_head first = {.mark = ENTRY_MARK,
                      .version = USUB_PROBE_VERSION,
                      .size = size,
                      .sequence = call->sequence,
                      .begin = call->begin,
                      .end = call->end,
                      .process = (int32_t)getpid(),
                      .thread = (int32_t)syscall(SYS_gettid),
                      .key = call->key,
                      .single = call->single,
                      .precision_basis = call->precision_basis,
                      .generation_basis = call->generation_basis,
                      .arguments = call->face->count};
  memcpy(first.lengths, call->lengths, sizeof first.lengths);
  size_t at = put(entry, &first, sizeof first);
  for (int32_t i = 0; i < call->face->count; ++i) {
    const usub_probe_value *value = &call->value[i];
    const size_t kept = value->data ? kept_of(value->readable) : 0;
    const entry_argument about = {.address = (uint64_t)(uintptr_t)value->address,
                                  .count = value->count,
                                  .bytes = value->bytes,
                                  .readable = value->readable,
                                  .kept = kept,
                                  .answered = value->answer ? kept : 0,
                                  .found = value->found,
                                  .refused = value->refused};
    at += put(entry + at, &about, sizeof about);
    if (kept)
      at += put(entry + at, value->data, kept);
    if (value->answer)
      at += put(entry + at, value->answer, kept);
  }
}

void usub_probe_record(const usub_probe_call *call, int chosen) {
  if (!usub_probe_is_recording())
    return;
  atomic_store(&shared->latest, call->end);
  if (!chosen || atomic_load(&shared->kept) >= shared->most_calls ||
      atomic_load(&shared->bytes) >= shared->most_bytes)
    return;
  const size_t size = size_of(call);
  char *entry = calloc(1, size);
  if (!entry)
    return;
  fill(call, entry, size);
  pthread_mutex_lock(&lock);
  if (write(file, entry, size) == (ssize_t)size) {
    atomic_fetch_add(&shared->kept, 1);
    atomic_fetch_add(&shared->bytes, (long long)size);
  }
  pthread_mutex_unlock(&lock);
  free(entry);
}
