! SPDX-License-Identifier: MIT
! Dahl's bristle, integrated over the increment by the theta rule; props: coefficient, stiffness,
! theta (0 explicit Euler, 1/2 trapezoidal rule, 1 implicit Euler). vectors: bend.
#define USUB_LAW 'dahl_theta'
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
    real(wp) :: limit, length, share, before(2), after(2), mean(2)
    integer :: b
    limit = props(1)*pressure/props(2)
    if (.not. limit > 0) then
      vectors(:, 1) = 0
      return
    end if
    associate (stiffness => props(2), theta => props(3))
      length = hypot(motion(1), motion(2))
      share = length/limit
      before = vectors(:, 1)
      after = (before + motion - (1 - theta)*share*before)/(1 + theta*share)
      mean = ((1 - theta)*before + theta*after)/(1 + theta*share)
      vectors(:, 1) = after
      traction = stiffness*after
      if (present(tangent)) then
        do b = 1, 2
          tangent(:, b) = 0
          if (length > 0) tangent(:, b) = -stiffness*(mean/limit)*(motion(b)/length)
          tangent(b, b) = tangent(b, b) + stiffness/(1 + theta*share)
        end do
        tangent(:, 3) = stiffness*mean*share/pressure
      end if
    end associate
  end subroutine
end module

#include "usersub/bristle_law.fi"
