! SPDX-License-Identifier: MIT
! Coefficient from a table over slip rate, pressure, temperature and field variables: linear
! inside, constant outside. props: see law_table.fi.
#define USUB_LAW 'coulomb_tabulated'
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
    needed_props = table_props(props, 1)
  end function

  function law( &
#include "usersub/law_names.fi"
      ) result(mu)
#include "usersub/law_types.fi"
    real(wp) :: mu
    call table_value(rate, pressure, temperature, fields, props, 1, mu, derivative)
  end function
end module

#include "usersub/coefficient_law.fi"
