! SPDX-License-Identifier: MIT
! Exponential decay between coefficients that are linear in temperature and pressure;
! props: Cs, Ds, Ck, Dk, decay.
#define USUB_LAW 'temperature_pressure_decay'
#define USUB_LAW_PROPS 5
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_PRESSURE
#define USUB_LAW_READS_TEMPERATURE
#include "usersub/laws.fi"

module usub_law_function
  use usub_law_tools
  implicit none
contains
  function law( &
#include "usersub/law_names.fi"
      ) result(mu)
#include "usersub/law_types.fi"
    real(wp) :: mu, at_rest, sliding, share
    at_rest = props(1)*temperature + props(2)*pressure
    sliding = props(3)*temperature + props(4)*pressure
    share = bounded_exp(-props(5)*rate)
    mu = sliding + (at_rest - sliding)*share
    if (mu < 0) then
      mu = 0
    else if (present(derivative)) then
      derivative(1) = -props(5)*(at_rest - sliding)*share
      derivative(2) = props(4) + (props(2) - props(4))*share
      derivative(3) = props(3) + (props(1) - props(3))*share
    end if
  end function
end module

#include "usersub/coefficient_law.fi"
