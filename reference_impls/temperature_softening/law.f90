! SPDX-License-Identifier: MIT
! A coefficient that falls with the temperature; props: form (1 power, 2 exponential), coefficient
! when cold and when hot, temperatures of both, exponent.
#define USUB_LAW 'temperature_softening'
#define USUB_LAW_PROPS 6
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
    real(wp) :: hot, fall, share, slope
    hot = props(3)
    fall = props(2) - hot
    if (props(1) == 1) then
      call drop_of_power(temperature, props(4), props(5), props(6), share, slope)
    else
      call decay_of_power(temperature, props(4), props(5), props(6), share, slope)
    end if
    mu = hot + fall*share
    if (present(derivative)) derivative(3) = fall*slope
  end function
end module

#include "usersub/coefficient_law.fi"
