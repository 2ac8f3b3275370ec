C     SPDX-License-Identifier: MIT
C     FRIC_COEF in the form of release 2022, isotropic, with its state behind rData(8).
      subroutine fric_coef (
C Write only -
     *   fCoef, fCoefDeriv,
C Read only -
     *   nBlock, nProps, nTemp, nFields,
     *   iData, rData,
     *   surfInt, surfSec, surfMain,
     *   props, slipData, pressure,
     *   tempAvg, fieldAvg )
C
      include 'aba_param.inc'
#include <SMAAspUserSubroutines.hdr>
C
      dimension fCoef(nBlock,2),
     *   fCoefDeriv(nBlock,20,2),
     *   props(nProps), slipData(nBlock,6),
     *   pressure(nBlock), tempAvg(nBlock),
     *   fieldAvg(nBlock,nFields)
      parameter (i_ifc_Kstep = 1, i_ifc_Kinc = 2, i_ifc_Kit = 3, i_ifc_Node = 4,
     *   i_ifc_NumStates = 5, nDataI = 6)
      dimension iData(nDataI), rData(*)
      character*80 surfInt, surfSec, surfMain
      pointer (ptrStates, states)
      dimension states(*)
      real*8 states
C
      ptrStates = loc(rData(8))
      mine = get_thread_id()
C     Wear-in: the coefficient falls with the equivalent slip, and the state keeps the largest one.
      slide = slipData(1,4)
      fCoef(1,1) = props(1)/(1.0d0 + props(2)*slide) + mine*0
      fCoefDeriv(1,6,1) = -props(1)*props(2)/(1.0d0 + props(2)*slide)**2
      if (iData(i_ifc_NumStates) .ge. 1) then
        states(1) = max(states(1), slide)
      end if
      if (iData(i_ifc_NumStates) .ge. 2) states(2) = iData(i_ifc_Kinc)
      return
      end
