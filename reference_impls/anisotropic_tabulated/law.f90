! SPDX-License-Identifier: MIT
! Two coefficients from tables over slip rate, pressure, temperature and field variables: linear
! inside, constant outside. props: see law_table.fi.
#define USUB_LAW 'anisotropic_tabulated'
#define USUB_LAW_ANISOTROPIC
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_PRESSURE
#define USUB_LAW_READS_TEMPERATURE
#define USUB_LAW_READS_FIELDS
#include "usersub/laws.fi"
#include "usersub/law_table.fi"

module usub_law_function
  use usub_law_tools
  use usub_law_tables
  implicit none
contains
  pure integer function needed_props(props)
    real(wp), intent(in) :: props(:)
    needed_props = table_props(props, 2)
  end function

  subroutine law( &
#include "usersub/law_names.fi"
      )
#include "usersub/law_types.fi"
    integer :: i
    do i = 1, 2
      if (present(derivative)) then
        call table_value(rate, pressure, temperature, fields, props, i, mu(i), derivative(:, i))
      else
        call table_value(rate, pressure, temperature, fields, props, i, mu(i))
      end if
    end do
  end subroutine
end module

#include "usersub/coefficient_law.fi"
