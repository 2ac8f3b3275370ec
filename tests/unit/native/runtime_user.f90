! SPDX-License-Identifier: MIT
! Routines that do not come back, as users write them.
subroutine fine() bind(c, name='fine')
end subroutine fine

subroutine call_xit() bind(c, name='call_xit')
  call xit
end subroutine call_xit

subroutine call_xplb_exit() bind(c, name='call_xplb_exit')
  call xplb_exit
end subroutine call_xplb_exit

subroutine stop_plain() bind(c, name='stop_plain')
  stop
end subroutine stop_plain

subroutine stop_number() bind(c, name='stop_number')
  stop 3
end subroutine stop_number

subroutine stop_text() bind(c, name='stop_text')
  stop 'no such material  '
end subroutine stop_text

subroutine error_stop_number() bind(c, name='error_stop_number')
  error stop 4
end subroutine error_stop_number

subroutine error_stop_text() bind(c, name='error_stop_text')
  error stop 'worse'
end subroutine error_stop_text

subroutine call_exit() bind(c, name='call_exit')
  call exit(5)
end subroutine call_exit

subroutine call_abort() bind(c, name='call_abort')
  call abort
end subroutine call_abort

subroutine bounds() bind(c, name='bounds')
  integer :: a(3)
  integer, volatile :: i
  i = 4
  a = i
  a(i) = 1
  if (a(1) == i) i = 5
end subroutine bounds

subroutine allocate_twice() bind(c, name='allocate_twice')
  real, allocatable :: a(:)
  allocate (a(3))
  allocate (a(4))
end subroutine allocate_twice

subroutine pause_once() bind(c, name='pause_once')
  pause 'look here'
end subroutine pause_once

! Messages: every value kind, in an order that differs from that of the arguments.
subroutine standard_message() bind(c, name='standard_message')
  integer :: ints(2)
  real(8) :: reals(2)
  character(8) :: names(2)
  ints = [12, -7]
  reals = [0.15d0, -2.5d6]
  names = ['BRAKE   ', 'PAD12345']
  call stdb_abqerr(1, 'a %S b %I c %R d %R e %S f %I g 100% h', ints, reals, names)
  call stdb_abqerr(-1, 'short %S', ints, reals, 'abc')
  call stdb_abqerr(-2, 'nothing to fill in   ', ints, reals, names)
end subroutine standard_message

subroutine explicit_message_double() bind(c, name='explicit_message_double')
  integer :: ints(1)
  real(8) :: reals(2)
  character(8) :: names(1)
  ints = 3
  reals = [0.1d0, 0.75d0]
  names = ' '
  call xplb_abqerr(-2, 'r %R %R i %I', ints, reals, names)
end subroutine explicit_message_double

subroutine explicit_message_single() bind(c, name='explicit_message_single')
  integer :: ints(1)
  real(4) :: reals(2)
  character(8) :: names(1)
  ints = 3
  reals = [0.1, 0.75]
  names = ' '
  call xplb_abqerr(-2, 'r %R %R i %I', ints, reals, names)
end subroutine explicit_message_single

! What the routine is told, as messages.
subroutine ask() bind(c, name='ask')
  character(80) :: part
  character(256) :: job, folder
  integer :: local, failed, job_length, folder_length, rank, processes
  integer, external :: get_thread_id, getNumThreads
  real(8) :: none(1)
  part = 'x'
  call getpartinfo(42, 0, part, local, failed)
  call stdb_abqerr(1, 'standard [%S] %I %I', [local, failed], none, part)
  part = 'x'
  call vgetpartinfo(43, 1, part, local, failed)
  call stdb_abqerr(1, 'explicit [%S] %I %I', [local, failed], none, part)
  call getpartinfo(0, 1, part, local, failed)
  call stdb_abqerr(1, 'refused %I', [failed], none, part)
  call getjobname(job, job_length)
  call getoutdir(folder, folder_length)
  call stdb_abqerr(1, 'job '//job(1:job_length)//' %I '//folder(1:folder_length)//' %I', &
                   [job_length, folder_length], none, part)
  call vgetjobname(job, job_length)
  call vgetoutdir(folder, folder_length)
  call stdb_abqerr(1, 'job '//trim(job)//' %I '//trim(folder)//' %I', &
                   [job_length, folder_length], none, part)
  call getrank(rank)
  call getnumcpus(processes)
  call stdb_abqerr(1, 'rank %I of %I', [rank, processes], none, part)
  call vgetrank(rank)
  call vgetnumcpus(processes)
  call stdb_abqerr(1, 'rank %I of %I', [rank, processes], none, part)
  call stdb_abqerr(1, 'thread %I of %I', [get_thread_id(), getNumThreads()], none, part)
end subroutine ask
