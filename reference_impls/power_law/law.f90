! SPDX-License-Identifier: MIT
! Powers of pressure, slip rate and temperature, each at least its floor; props: factor; exponents
! of pressure, slip rate, temperature; their floors.
#define USUB_LAW 'power_law'
#define USUB_LAW_PROPS 7
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_PRESSURE
#define USUB_LAW_READS_TEMPERATURE
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
    real(wp) :: mu
    real(wp) :: given(3), bases(3)
    given = [pressure, rate, temperature]
    bases = max(given, props(5:7))
    mu = product_of_powers(props(1), bases, props(2:4))
    if (present(derivative)) then
      where (given >= props(5:7)) derivative([2, 1, 3]) = props(2:4)*mu/bases
    end if
  end function
end module

#include "usersub/coefficient_law.fi"
