! SPDX-License-Identifier: MIT
! Coefficient from a table over slip rate, pressure and temperature: linear inside, constant outside.
! props: numbers of rates, pressures, temperatures; these points, ascending; the coefficients, the
! rate running fastest.
#define USUB_LAW 'coulomb_tabulated'
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_PRESSURE
#define USUB_LAW_READS_TEMPERATURE
#include "usersub/laws.fi"

module usub_law_function
  use usub_law_tools
  implicit none
  ! Where a value lies among ascending points: interval, share of its upper end, 1/width or 0.
  type :: place
    integer :: ends(2)
    real(wp) :: share, slope
  end type
contains
  ! Properties that the table takes; one more than there are, if the sizes make no sense.
  pure integer function needed_props(props)
    real(wp), intent(in) :: props(:)
    real(wp) :: needed
    needed_props = 7
    if (size(props) < 7) return
    needed_props = size(props) + 1
    if (.not. all(props(1:3) >= 1 .and. props(1:3) <= size(props))) return
    needed = 3 + sum(aint(props(1:3))) + product(aint(props(1:3)))
    if (needed <= size(props)) needed_props = int(needed)
  end function

  pure function find(points, x) result(at)
    real(wp), intent(in) :: points(:), x
    type(place) :: at
    integer :: middle, n
    n = size(points)
    at = place([1, 1], 0.0_wp, 0.0_wp)
    if (n < 2 .or. x < points(1)) return
    at%ends = n
    if (x >= points(n)) return
    at%ends(1) = 1
    do while (at%ends(2) - at%ends(1) > 1)
      middle = (at%ends(1) + at%ends(2))/2
      if (x < points(middle)) then
        at%ends(2) = middle
      else
        at%ends(1) = middle
      end if
    end do
    associate (low => points(at%ends(1)), high => points(at%ends(2)))
      at%slope = 1/(high - low)
      at%share = (x - low)/(high - low)
    end associate
  end function

  elemental function between(low, high, share)
    real(wp), intent(in) :: low, high, share
    real(wp) :: between
    between = low + (high - low)*share
  end function

  function law(rate, pressure, temperature, props, derivative) result(mu)
    real(wp), intent(in) :: rate, pressure, temperature, props(:)
    real(wp), intent(inout), optional :: derivative(3)
    real(wp) :: mu, value(2, 2), by_rate(2, 2), cold, warm
    integer :: n(3), last(3), i, j, row
    type(place) :: r, p, t
    n = int(props(1:3))
    last = 3 + [n(1), n(1) + n(2), sum(n)]
    r = find(props(4:last(1)), rate)
    p = find(props(last(1) + 1:last(2)), pressure)
    t = find(props(last(2) + 1:last(3)), temperature)
    do j = 1, 2
      do i = 1, 2
        row = last(3) + n(1)*(p%ends(i) - 1 + n(2)*(t%ends(j) - 1))
        associate (low => props(row + r%ends(1)), high => props(row + r%ends(2)))
          value(i, j) = between(low, high, r%share)
          by_rate(i, j) = (high - low)*r%slope
        end associate
      end do
    end do
    cold = between(value(1, 1), value(2, 1), p%share)
    warm = between(value(1, 2), value(2, 2), p%share)
    mu = between(cold, warm, t%share)
    if (present(derivative)) then
      derivative(1) = between(between(by_rate(1, 1), by_rate(2, 1), p%share), &
          between(by_rate(1, 2), by_rate(2, 2), p%share), t%share)
      derivative(2) = between((value(2, 1) - value(1, 1))*p%slope, &
          (value(2, 2) - value(1, 2))*p%slope, t%share)
      derivative(3) = (warm - cold)*t%slope
    end if
  end function
end module

#include "usersub/coefficient_law.fi"
