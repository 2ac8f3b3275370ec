! SPDX-License-Identifier: MIT
! Rough friction: no slip while a point is closed. FRIC asks for it; in explicit analyses the force
! is the one that ends all motion.
#include "usersub/laws.fi"

subroutine vfric( &
#include "usersub/arguments/vfric_names.fi"
  use usub_law_tools
  implicit none
#include "usersub/arguments/vfric_types.fi"
  fTangential(1, :) = -fStickForce
end subroutine

subroutine vfriction( &
#include "usersub/arguments/vfriction_names.fi"
  use usub_law_tools
  implicit none
#include "usersub/arguments/vfriction_types.fi"
  fTangential(1, :) = -fStickForce
end subroutine

#ifndef USUB_SINGLE
subroutine fric( &
#include "usersub/arguments/fric_names.fi"
  use usub_law_tools
  implicit none
#include "usersub/arguments/fric_types.fi"
  LM = 1
end subroutine
#endif
