! SPDX-License-Identifier: MIT
! Exponential decay from a static to a kinetic coefficient; props: static, kinetic, decay.
#define USUB_LAW 'exponential_decay'
#define USUB_LAW_READS_RATE
#include "usersub/laws.fi"

module usub_law_function
  use usub_law_tools
  implicit none
contains
  pure integer function needed_props(props)
    real(wp), intent(in) :: props(:)
    needed_props = 3
  end function

  function law(rate, pressure, temperature, props, derivative) result(mu)
    real(wp), intent(in) :: rate, pressure, temperature, props(:)
    real(wp), intent(inout), optional :: derivative(3)
    real(wp) :: mu, transition
    transition = (props(1) - props(2))*bounded_exp(-props(3)*rate)
    mu = props(2) + transition
    if (present(derivative)) derivative(1) = -props(3)*transition
  end function
end module

#include "usersub/coefficient_law.fi"
