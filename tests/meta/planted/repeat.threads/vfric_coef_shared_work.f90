! SPDX-License-Identifier: MIT
! The rates go through a scratch array that all threads share.
! planted: repeat.threads: thread
! props: 0.3, 0.2, 5
! precision: single
subroutine vfric_coef( &
#include "usersub/arguments/vfric_coef_names.fi"
  implicit none
#include "usersub/arguments/vfric_coef_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, rate
  real(wp), save, volatile :: work(4096)
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  do k = 1, min(nBlock, 4096)
    work(k) = slipRate(k)
  end do
  do k = 1, nBlock
    rate = slipRate(k)
    if (k <= 4096) rate = work(k)
    fCoef(k) = moving + (rest - moving)*exp(-decay*rate)
  end do
end subroutine
