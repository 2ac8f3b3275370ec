! SPDX-License-Identifier: MIT
! Coulomb friction whose elastic slip has a given stiffness; props: coefficient, slope of shear
! stress over elastic slip. vectors: elastic slip.
#define USUB_LAW 'softened'
#define USUB_LAW_PROPS 2
#define USUB_LAW_VECTORS 1
#define USUB_LAW_READS_PRESSURE
#include "usersub/laws.fi"

module usub_law_function
  use usub_law_tools
  implicit none
contains
  subroutine bristle( &
#include "usersub/bristle_names.fi"
      )
#include "usersub/bristle_types.fi"
    real(wp) :: strength, trial(2), length, direction(2)
    logical :: sticks
    integer :: j
    strength = props(1)*pressure
    ! an elastic slip below the smallest normal number has no digits: it carries nothing
    if (.not. strength > props(2)*tiny(strength)) strength = 0
    trial = vectors(:, 1) + motion
    length = hypot(trial(1), trial(2))
    if (props(2)*length < strength) then
      vectors(:, 1) = trial
      traction = props(2)*trial
      if (present(tangent)) then
        tangent(1, 1) = props(2)
        tangent(2, 2) = props(2)
      end if
      return
    end if
    ! left at its limit by a slip, it is above by rounding: at rest its tangent is that of stick
    sticks = strength > 0 .and. props(2)*length <= strength*(1 + 4*epsilon(strength))
    if (.not. length > 0) length = 1 ! no strength either
    direction = trial/length
    traction = strength*direction
    vectors(:, 1) = traction/props(2)
    if (present(tangent) .and. sticks) then
      tangent(1, 1) = props(2)
      tangent(2, 2) = props(2)
    else if (present(tangent)) then
      do j = 1, 2
        tangent(:, j) = -direction*direction(j)*(strength/length)
        tangent(j, j) = tangent(j, j) + strength/length
      end do
      tangent(:, 3) = props(1)*direction
    end if
  end subroutine
end module

#include "usersub/bristle_law.fi"
