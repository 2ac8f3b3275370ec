# SPDX-License-Identifier: MIT
"""The compiled helpers for Fortran units: connecting them, and ending statements left half done."""

from __future__ import annotations

from pathlib import Path

from usersub.errors import CompileError
from usersub.routine import cache, compilers

_SINGLE = ("open", "close", "inquire", "rewind", "backspace", "endfile")
#: Linker flags for the object of `watch`.
WATCH_FLAGS = tuple(
    f"-Wl,--wrap=_gfortran_st_{verb}"
    for verb in ("write", "write_done", "read", "read_done", *_SINGLE)
)
#: Function of a watched library that ends what is left half done; to be called outside of routines.
RECOVER = "usub_units_recover"

# A routine that stops or crashes inside of a WRITE (in a function in its list, say) leaves the unit
# locked, and the next use of the unit would wait for ever. So each statement notes its parameter
# block until it is done; a block in a stack frame that is gone belongs to such a statement, which
# is then ended with the copy.
#
# An error for which the routine has neither IOSTAT= nor ERR= ends the program within the run-time
# library. So each statement without IOSTAT= gets one, and the routine is stopped when the statement
# is done and has failed.
_WATCH = """\
#include <string.h>
enum { DEPTH = 8, BYTES = 1024, LONGEST = 160 };
enum { RESULT = 3, HAS_IOSTAT = 1 << 5, HAS_IOMSG = 1 << 6 };
/* The beginning of every parameter block. */
typedef struct {
  int flags, unit;
  const char *file;
  int line;
  size_t message_length;
  char *message;
  int *iostat;
} common;
typedef struct {
  int armed, iostat;
  char message[LONGEST + 1];
} outcome;
static __thread struct {
  char *block;
  void (*done)(void *);
  outcome outcome;
  char copy[BYTES];
} open_[DEPTH];
static __thread int count;
extern void __wrap__gfortran_runtime_error_at(const char *, const char *, ...);
static void arm(common *c, outcome *o) {
  o->armed = !(c->flags & HAS_IOSTAT);
  o->iostat = 0;
  if (!o->armed) return;
  memset(o->message, 0, sizeof o->message);
  c->flags |= HAS_IOSTAT;
  c->iostat = &o->iostat;
  if (c->flags & HAS_IOMSG) return;
  c->flags |= HAS_IOMSG;
  c->message = o->message;
  c->message_length = LONGEST;
}
/* The flags say whether it was an error (1), the end of the file (2) or of a record (3), and, one
 * bit each from the third on, whether the statement has a label for it. */
static void judge(const common *c, outcome *o) {
  int result = c->flags & RESULT;
  if (!o->armed || o->iostat == 0 || (result && c->flags & 2 << result)) return;
  for (int i = LONGEST; i > 0 && (o->message[i - 1] == ' ' || !o->message[i - 1]); i--)
    o->message[i - 1] = 0;
  for (char *at = o->message; *at; at++)
    if (*at == '\\n') *at = ' ';
  __wrap__gfortran_runtime_error_at("", "%s (%s, line %d)", o->message, c->file, c->line);
}
static void end_above(const char *here) {
  while (count > 0 && open_[count - 1].block < here) {
    count--;
    open_[count].done(open_[count].copy);
  }
}
static void begin(char *block, void (*start)(void *), void (*done)(void *)) {
  char here;
  end_above(&here);
  if (count < DEPTH) {
    int mine = count++;
    open_[mine].block = block;
    open_[mine].done = done;
    arm((common *)block, &open_[mine].outcome);
    start(block);
    memcpy(open_[mine].copy, block, BYTES);
  } else {
    start(block);
  }
}
static void end(char *block, void (*done)(void *)) {
  done(block);
  if (count > 0 && open_[count - 1].block == block) {
    count--;
    judge((common *)block, &open_[count].outcome);
  }
}
#define WATCH(verb)                                                    \\
  void __real__gfortran_st_##verb(void *);                             \\
  void __real__gfortran_st_##verb##_done(void *);                      \\
  void __wrap__gfortran_st_##verb(char *block) {                       \\
    begin(block, __real__gfortran_st_##verb, __real__gfortran_st_##verb##_done); \\
  }                                                                    \\
  void __wrap__gfortran_st_##verb##_done(char *block) {                \\
    end(block, __real__gfortran_st_##verb##_done);                     \\
  }
#define SINGLE(verb)                                                   \\
  void __real__gfortran_st_##verb(void *);                             \\
  void __wrap__gfortran_st_##verb(void *block) {                       \\
    outcome o;                                                         \\
    char here;                                                         \\
    end_above(&here);                                                  \\
    arm(block, &o);                                                    \\
    __real__gfortran_st_##verb(block);                                 \\
    judge(block, &o);                                                  \\
  }
WATCH(write)
WATCH(read)
SINGLE(open)
SINGLE(close)
SINGLE(inquire)
SINGLE(rewind)
SINGLE(backspace)
SINGLE(endfile)
void usub_units_recover(void) { end_above((const char *)-1); }
"""

_CONNECT = """\
subroutine usub_unit_open(unit, path, length, state) bind(c)
  use iso_c_binding
  integer(c_int), value :: unit, length
  character(kind=c_char), intent(in) :: path(*)
  integer(c_int), intent(out) :: state
  character(len=length) :: name
  integer :: i
  do i = 1, length
    name(i:i) = path(i)
  end do
  open (unit=unit, file=name, form='formatted', status='old', action='readwrite', iostat=state)
end subroutine
integer(c_int) function usub_unit_flush(unit, path, length) bind(c)
  use iso_c_binding
  integer(c_int), value :: unit, length
  character(kind=c_char), intent(in) :: path(*)
  character(len=4096) :: name
  logical :: connected
  integer :: i
  inquire (unit=unit, opened=connected)
  usub_unit_flush = 0
  if (.not. connected) return
  flush (unit)
  inquire (unit=unit, name=name)
  usub_unit_flush = 1
  if (len_trim(name) /= length) usub_unit_flush = 2
  do i = 1, min(length, len(name))
    if (name(i:i) /= path(i)) usub_unit_flush = 2
  end do
  if (index(name, 'fort.', back=.true.) == max(1, len_trim(name) - 5) .and. &
      usub_unit_flush == 2) usub_unit_flush = 3
end function
subroutine usub_unit_again(unit) bind(c)
  use iso_c_binding
  integer(c_int), value :: unit
  rewind (unit)
end subroutine
subroutine usub_unit_delete(unit) bind(c)
  use iso_c_binding
  integer(c_int), value :: unit
  close (unit, status='delete')
end subroutine
"""


def watch(compiler: compilers.Compiler, folder: Path) -> Path:
    """The object that watches the WRITE and READ statements of the library it is linked into."""
    source = folder / "usub_watch.c"
    source.write_text(_WATCH, encoding="ascii")
    made = source.with_suffix(".o")
    command = [*compiler.command, "-x", "c", "-O1", "-fPIC", "-c", source.name, "-o", made.name]
    outcome = compilers.run(command, folder)
    if outcome.code:
        raise CompileError(f"the watch over units cannot be compiled: {outcome.text.strip()}")
    return made


def connector() -> Path:
    """The library that connects, flushes, rewinds and deletes units.

    Raises:
        MissingTool, CompileError: there is no gfortran, or it fails.
    """
    compiler = compilers.find("fortran")
    target = cache.path("units", cache.key("units", compiler.version, _CONNECT), ".so")
    if not target.is_file():
        with cache.build_folder() as folder:
            (folder / "units.f90").write_text(_CONNECT, encoding="ascii")
            command = [*compiler.command, "-O1", "-fPIC", "-shared", "units.f90", "-o", "units.so"]
            outcome = compilers.run(command, folder)
            if outcome.code:
                raise CompileError(f"units 6 and 7 cannot be connected: {outcome.text.strip()}")
            cache.put(folder / "units.so", target)
    return target
