! SPDX-License-Identifier: MIT
! Coulomb friction: a constant coefficient, props(1).
#define USUB_LAW 'coulomb'
#include "usersub/laws.fi"

module usub_law_function
  use usub_law_tools
  implicit none
contains
  pure integer function needed_props(props)
    real(wp), intent(in) :: props(:)
    needed_props = 1
  end function

  function law(rate, pressure, temperature, props, derivative) result(mu)
    real(wp), intent(in) :: rate, pressure, temperature, props(:)
    real(wp), intent(inout), optional :: derivative(3)
    real(wp) :: mu
    mu = props(1)
  end function
end module

#include "usersub/coefficient_law.fi"
