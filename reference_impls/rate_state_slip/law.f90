! SPDX-License-Identifier: MIT
! Rate and state friction, slip law, logarithmic; props: mu0, a, b, V0, Dc, theta0, Vmin.
#define USUB_LAW 'rate_state_slip'
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
    real(wp) :: mu, x, v, distance, by_rate, mean, slope
    associate (mu0 => props(1), a => props(2), b => props(3), v0 => props(4), dc => props(5), &
        theta0 => props(6), v_min => props(7), theta => state(1))
      if (.not. theta > 0) theta = theta0
      x = rate*time_increment/dc
      v = max(rate, v_min, tiny(rate))
      distance = log_scaled(v, theta, dc) ! from the steady state
      if (x < 0.7_wp) then
        theta = theta*exp(distance*expm1(-x))
      else ! at large slip theta is counted from its steady state
        theta = dc/v*exp(distance*exp(-x))
      end if
      theta = max(theta, tiny(theta)) ! 0 was never set
      mu = mu0 + a*log_scaled(1.0_wp, v, v0) + b*log_scaled(v0, theta, dc)
      if (mu < 0) then
        mu = 0
      else if (present(derivative)) then
        by_rate = -distance*exp(-x)
        if (.not. rate < v) then
          call mean_decay(x, mean, slope)
          by_rate = by_rate - mean
          derivative(1) = a/v
        end if
        if (.not. x > steady_from) then
          by_rate = by_rate*(time_increment/dc)
        else if (.not. rate < v) then
          by_rate = -1/v
        else
          by_rate = 0
        end if
        derivative(1) = derivative(1) + b*by_rate
      end if
    end associate
  end function
end module

#include "usersub/coefficient_law.fi"
