! SPDX-License-Identifier: MIT
! Creep without a yield point: slip rate = k traction; props: k.
#define USUB_LAW 'viscoplastic_creep'
#define USUB_LAW_READS_RATE
#include "usersub/laws.fi"

module usub_law_function
  use usub_law_tools
  implicit none
contains
  pure integer function needed_props(props)
    real(wp), intent(in) :: props(:)
    needed_props = 1
  end function

  function law(rate, pressure, temperature, props, derivative) result(traction)
    real(wp), intent(in) :: rate, pressure, temperature, props(:)
    real(wp), intent(inout), optional :: derivative(3)
    real(wp) :: traction
    traction = rate/props(1)
    if (present(derivative)) derivative(1) = 1/props(1)
  end function
end module

#include "usersub/traction_law.fi"
