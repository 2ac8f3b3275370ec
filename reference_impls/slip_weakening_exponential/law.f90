! SPDX-License-Identifier: MIT
! Coefficient that decays with the accumulated slip; props: static, dynamic, distance.
#define USUB_LAW 'slip_weakening_exponential'
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
    real(wp) :: mu, left
    state(1) = state(1) + slip
    left = (props(1) - props(2))*bounded_exp(-state(1)/props(3))
    mu = props(2) + left
    if (present(derivative)) derivative(4) = -left/props(3)
  end function
end module

#include "usersub/coefficient_law.fi"
