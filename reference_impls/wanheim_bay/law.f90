! SPDX-License-Identifier: MIT
! Wanheim-Bay friction, from a coefficient at low pressure to a share of the shear yield stress at
! high pressure; props: friction factor, shear yield stress.
#define USUB_LAW 'wanheim_bay'
#define USUB_LAW_PROPS 2
#define USUB_LAW_READS_PRESSURE
#include "usersub/laws.fi"
#include "usersub/law_functions.fi"

module usub_law_function
  use usub_law_tools
  use usub_law_functions
  use usub_law_pairs
  implicit none
contains
  function law( &
#include "usersub/law_names.fi"
      ) result(mu)
#include "usersub/law_types.fi"
    real(wp) :: mu
    ! In pairs, since the errors of so many operations add up.
    type(usub_pair), parameter :: one = usub_pair(1.0_dp, 0.0_dp), &
        quarter_turn = usub_pair(1.5707963267948966_dp, 6.123233995736766e-17_dp)
    type(usub_pair) :: f, k, p, q, angle, mu0, x, grown
    real(dp) :: fade, slope
    f = pair(real(props(1), dp))
    k = pair(real(props(2), dp))
    p = pair(real(pressure, dp))
    q = sqrt(one - f)
    angle = one + sqrt((one - f)*(one + f)) + quarter_turn + pair(acos(f%high))
    mu0 = f/angle
    x = p*(one + q)/(k*angle) ! p over the limit of proportionality
    grown = mu0
    slope = 0
    if (total(x - one) > 0) then
      fade = expm1(-total(x - one)/q%high)
      grown = mu0*(one - exact_product(q%high, fade))/x
      slope = (mu0%high*(1 + fade) - grown%high)/p%high
    end if
    mu = real(total(grown), wp)
    if (present(derivative)) derivative(2) = real(slope, wp)
  end function
end module

#include "usersub/coefficient_law.fi"
