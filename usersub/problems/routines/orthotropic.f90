! SPDX-License-Identifier: MIT
! Friction along the slip, direction by direction with its own coefficient; props: both
! coefficients, allowable elastic slip. vectors: elastic slip.
#define USUB_LAW 'orthotropic'
#define USUB_LAW_PROPS 3
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
    real(wp) :: trial(2), length, reach, direction(2)
    integer :: j
    trial = vectors(:, 1) + motion
    length = hypot(trial(1), trial(2))
    reach = max(length, props(3))
    direction = trial/reach
    vectors(:, 1) = trial
    if (length >= props(3)) vectors(:, 1) = props(3)*direction
    traction = props(1:2)*pressure*direction
    if (present(tangent)) then
      do j = 1, 2
        tangent(j, j) = 1
        if (length >= props(3)) tangent(:, j) = tangent(:, j) - direction*direction(j)
        tangent(:, j) = tangent(:, j)*props(1:2)*pressure/reach
      end do
      tangent(:, 3) = props(1:2)*direction
    end if
  end subroutine
end module

#include "usersub/bristle_law.fi"
