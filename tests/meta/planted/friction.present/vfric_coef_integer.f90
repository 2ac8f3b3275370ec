! SPDX-License-Identifier: MIT
! The coefficient is kept in an integer and is zero.
! planted: friction.present: is 0 in all
! props: 0.3, 0.2, 5
! precision: single
! also: precision.digits
subroutine vfric_coef( &
#include "usersub/arguments/vfric_coef_names.fi"
  implicit none
#include "usersub/arguments/vfric_coef_types.fi"
  integer, parameter :: wp = kind(props)
  real(wp) :: rest, moving, decay, rate
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  do k = 1, nBlock
    rate = slipRate(k)
    fCoef(k) = int(moving + (rest - moving)*exp(-decay*rate))
  end do
end subroutine
