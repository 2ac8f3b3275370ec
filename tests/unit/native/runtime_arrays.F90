! SPDX-License-Identifier: MIT
! Arrays and mutexes as field code uses them: Cray pointers and the published include file.
subroutine arrays() bind(c, name='arrays')
#include <SMAAspUserSubroutines.hdr>
  integer :: ints(4), none(1)
  real(8) :: reals(3), given(1)
  integer(8) :: size
  pointer(p_ints, ints), (p_reals, reals)
  none = 0
  given = 0
  if (SMAIntArrayAccess(7) /= 0) stop 1
  p_ints = SMAIntArrayCreate(7, 4)
  if (any(ints /= huge(1))) stop 2
  ints = [3, 1, 4, 1]
  p_reals = SMAFloatArrayCreate(7, 3, 2.5d0)
  if (any(reals /= 2.5d0)) stop 3
  if (SMAIntArrayAccess(7) /= p_ints .or. SMAFloatArrayAccess(7) /= p_reals) stop 4
  size = SMAIntArraySize(7)
  if (size /= 4 .or. SMAFloatArraySize(7) /= 3 .or. SMAFloatArraySize(8) /= 0) stop 5
  p_ints = SMAIntArrayCreate(7, 6, 9)
  if (ints(3) /= 4 .or. SMAIntArraySize(7) /= 6) stop 6
  if (SMALocalIntArrayAccess(7) /= 0) stop 7
  p_reals = SMALocalFloatArrayCreate(7, 3, -1.5d0)
  if (any(reals /= -1.5d0)) stop 8
  call SMALocalFloatArrayDelete(7)
  if (SMALocalFloatArrayAccess(7) /= 0 .or. SMAFloatArrayAccess(7) == 0) stop 9
  call SMAIntArrayDelete(7)
  call SMAFloatArrayDelete(7)
  if (SMAIntArrayAccess(7) /= 0 .or. SMAFloatArraySize(7) /= 0) stop 10
  if (SMAStructArrayAccess(7) /= 0) stop 11
  if (SMAStructArrayCreate(7, 5, 24) == 0 .or. SMAStructArraySize(7) /= 5) stop 12
  call SMAStructArrayDelete(7)
  call MutexInit(100)
  call MutexLock(100)
  call MutexUnlock(100)
  call MutexUnlock(100)
  call MutexLock(99)
  if (get_thread_id() /= 0 .or. getNumThreads() /= 1) stop 13
  call stdb_abqerr(1, 'done', none, given, ' ')
end subroutine arrays

subroutine fine() bind(c, name='fine')
end subroutine fine
