! SPDX-License-Identifier: MIT
! Rate and state friction, ageing law, logarithmic; props: mu0, a, b, V0, Dc, theta0, Vmin.
#define USUB_LAW 'rate_state_ageing'
#define USUB_LAW_PROPS 7
#define USUB_LAW_STATES 1
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_TIME
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
    real(wp) :: mu, theta_by_rate
    associate (mu0 => props(1), a => props(2), b => props(3), v0 => props(4), dc => props(5), &
        theta0 => props(6), v_min => props(7), theta => state(1))
      if (.not. theta > 0) theta = theta0
      call aged(theta, rate, time_increment, dc, theta_by_rate)
      mu = mu0 + a*log_scaled(1.0_wp, max(rate, v_min), v0) + b*log_scaled(v0, theta, dc)
      if (mu < 0) then
        mu = 0
      else if (present(derivative)) then
        derivative(1) = b*(theta_by_rate/theta)
        if (.not. rate < v_min) derivative(1) = derivative(1) + a/rate
      end if
    end associate
  end function
end module

#include "usersub/coefficient_law.fi"
