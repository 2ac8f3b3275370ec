! SPDX-License-Identifier: MIT
! Norton-Hoff friction, a power of the slip rate; props: consistency, exponent, rate below which the
! traction becomes linear.
#define USUB_LAW 'norton_hoff'
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
      ) result(traction)
#include "usersub/law_types.fi"
    real(wp) :: traction
    real(wp) :: n, length, power
    n = props(2)
    length = hypot(rate, props(3))
    if (.not. length > 0) then
      traction = 0
      if (present(derivative) .and. n == 1) derivative(1) = props(1)
      return
    end if
    power = product_of_powers(props(1), [length], [n])
    traction = power*(rate/length)
    if (present(derivative)) derivative(1) = power/length*(1 + (n - 1)*(rate/length)**2)
  end function
end module

#include "usersub/traction_law.fi"
