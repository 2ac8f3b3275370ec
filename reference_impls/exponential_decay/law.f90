! SPDX-License-Identifier: MIT
! Exponential decay from a static to a kinetic coefficient; props: static, kinetic, decay.
#define USUB_LAW 'exponential_decay'
#define USUB_LAW_PROPS 3
#define USUB_LAW_READS_RATE
#include "usersub/laws.fi"
#include "usersub/law_functions.fi"

module usub_law_function
  use usub_law_tools
  use usub_law_functions
  implicit none
contains
  function law( &
#include "usersub/law_names.fi"
      ) result(mu)
#include "usersub/law_types.fi"
    real(wp) :: mu, fall, transition
    fall = props(1) - props(2)
    transition = fall*bounded_exp(-props(3)*rate)
    mu = props(2) + transition
    if (fall < 0) mu = props(1) + fall*expm1(-props(3)*rate) ! nothing cancels from this end
    if (present(derivative)) derivative(1) = -props(3)*transition
  end function
end module

#include "usersub/coefficient_law.fi"
