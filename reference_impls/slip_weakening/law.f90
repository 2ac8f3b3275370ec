! SPDX-License-Identifier: MIT
! Coefficient that falls linearly with the accumulated slip; props: static, dynamic, distance.
#define USUB_LAW 'slip_weakening'
#define USUB_LAW_PROPS 3
#define USUB_LAW_STATES 1
#define USUB_LAW_READS_SLIP
#include "usersub/laws.fi"

module usub_law_function
  use usub_law_tools
  implicit none
contains
  function law( &
#include "usersub/law_names.fi"
      ) result(mu)
#include "usersub/law_types.fi"
    real(wp) :: mu, left, drop
    left = (props(3) - state(1)) - slip
    drop = props(1) - props(2)
    state(1) = state(1) + slip
    mu = props(2)
    if (.not. left > 0) return ! at the corner the derivative is that of further slip: none
    mu = props(2) + drop*(left/props(3))
    if (present(derivative)) derivative(4) = -drop/props(3)
  end function
end module

#include "usersub/coefficient_law.fi"
