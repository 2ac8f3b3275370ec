/* SPDX-License-Identifier: MIT */
/* Reading and writing memory that may not be there. */
#include <errno.h>
#include <pthread.h>
#include <string.h>
#include <sys/uio.h>
#include <unistd.h>

#include "probe.h"

#define PAGE 4096u

/* A pipe does the same as process_vm_readv where a sandbox forbids that: the kernel answers EFAULT
 * instead of raising a signal. */
static pthread_mutex_t pipe_lock = PTHREAD_MUTEX_INITIALIZER;
static int pipe_ends[2] = {-1, -1};

static size_t through_pipe(const void *from, void *to, size_t bytes) {
  size_t done = 0;
  pthread_mutex_lock(&pipe_lock);
  if (pipe_ends[0] >= 0 || pipe(pipe_ends) == 0) {
    while (done < bytes) {
      /* Never over the end of a page: what is readable up to it counts. */
      const size_t left = bytes - done;
      const size_t room_from = PAGE - (size_t)((uintptr_t)from + done) % PAGE;
      const size_t room_to = PAGE - (size_t)((uintptr_t)to + done) % PAGE;
      size_t part = room_from < room_to ? room_from : room_to;
      part = part < left ? part : left;
      if (write(pipe_ends[1], (const char *)from + done, part) != (ssize_t)part)
        break;
      if (read(pipe_ends[0], (char *)to + done, part) != (ssize_t)part) {
        char rest[PAGE];
        (void)!read(pipe_ends[0], rest, part);
        break;
      }
      done += part;
    }
  }
  pthread_mutex_unlock(&pipe_lock);
  return done;
}

static size_t transfer(void *here, void *there, size_t bytes, int writes) {
  size_t done = 0;
  while (done < bytes) {
    struct iovec local = {(char *)here + done, bytes - done};
    struct iovec remote = {(char *)there + done, bytes - done};
    const pid_t self = getpid();
    const ssize_t moved = writes ? process_vm_writev(self, &local, 1, &remote, 1, 0)
                                 : process_vm_readv(self, &local, 1, &remote, 1, 0);
    if (moved < 0 && (errno == ENOSYS || errno == EPERM)) {
      const size_t left = bytes - done;
      return done + (writes ? through_pipe((char *)here + done, (char *)there + done, left)
                            : through_pipe((char *)there + done, (char *)here + done, left));
    }
    if (moved <= 0)
      break;
    done += (size_t)moved;
  }
  return done;
}

size_t usub_probe_read(const void *address, void *to, size_t bytes) {
  return transfer(to, (void *)(uintptr_t)address, bytes, 0);
}

int usub_probe_read_all(const usub_probe_piece *pieces, int32_t count) {
  struct iovec local[USUB_PROBE_ARGUMENTS], remote[USUB_PROBE_ARGUMENTS];
  size_t total = 0;
  if (count > USUB_PROBE_ARGUMENTS)
    return 0;
  for (int32_t i = 0; i < count; ++i) {
    local[i] = (struct iovec){pieces[i].to, pieces[i].bytes};
    remote[i] = (struct iovec){(void *)(uintptr_t)pieces[i].address, pieces[i].bytes};
    total += pieces[i].bytes;
  }
  const size_t n = (size_t)count;
  return process_vm_readv(getpid(), local, n, remote, n, 0) == (ssize_t)total;
}

size_t usub_probe_write(void *address, const void *from, size_t bytes) {
  return transfer((void *)(uintptr_t)from, address, bytes, 1);
}
