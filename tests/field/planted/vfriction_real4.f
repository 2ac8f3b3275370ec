C     SPDX-License-Identifier: MIT
C     Nothing makes reals double: the typing rule is missing.
#include <SMAAspUserSubroutines.hdr>
      MODULE LAW
      IMPLICIT NONE
      REAL*8, PARAMETER :: TINYSLIP = 1.D-30
      CONTAINS
      REAL*8 FUNCTION COEFFICIENT(VSLIP, XMUS, XMUK, DECAY)
      REAL*8, INTENT(IN) :: VSLIP, XMUS, XMUK, DECAY
      COEFFICIENT = XMUK + (XMUS - XMUK)*EXP(-DECAY*VSLIP)
      END FUNCTION COEFFICIENT
      INTEGER FUNCTION THREADOFMODULE()
      THREADOFMODULE = Get_Thread_Id()
      END FUNCTION THREADOFMODULE
      END MODULE LAW
C
      Subroutine VFriction ( fTangential, state,
     *   nBlock, nBlockAnal, nBlockEdge, nNodState, nNodSec, nNodMain, nFricDir, nDir, nStates, nProps, nTemp, nFields,
     *   jFlags, rData, surfInt, surfSec, surfMain, jConSecUid, jConMainUid,
     *   props, dSlipFric, fStickForce, fTangPrev, fNormal, areaCont, dircosN, dircosSl, shapeSec, shapeMain,
     *   coordSec, coordMain, velSec, velMain, tempSec, tempMain, fieldSec, fieldMain )
      Use Law, Only: Coefficient, TinySlip, ThreadOfModule
      Parameter( iKStep=1, iKInc=2, iLConType=3, nFlags=3, iTimStep=1, iTimGlb=2, iDTimCur=3, iFrictionWork=4, nData=4 )
      Dimension fTangential(nFricDir,nBlock), state(nStates,nNodState,nBlock), jConSecUid(nNodSec,nBlock),
     *   jConMainUid(nNodMain,nBlockAnal), props(nProps), dSlipFric(nDir,nBlock), fStickForce(nBlock), fTangPrev(nDir,nBlock),
     *   fNormal(nBlock), areaCont(nBlock), jFlags(nFlags), rData(nData)
      Character*80 surfInt, surfSec, surfMain
      Integer first
C     Without its type get_thread_id would be real, and first garbage.
      first = get_thread_id() + 1
      nthreads = getNumThreads()
      Do k = 1, nBlock
        If ( fNormal(k) .ne. 0. .and. rData(iDTimCur) .gt. 0. ) Then
          vslip = dSlipFric(1,k)/rData(iDTimCur)
          xmu = Coefficient(Dble(vslip), Dble(props(1)), Dble(props(2)), Dble(props(3)))
          fTangential(1,k) = - Min(xmu*fNormal(k), fStickForce(k))
          If ( nStates .ge. 2 ) Then
            state(1,1,k) = first
            state(2,1,k) = Mod(nthreads, 1) + jConSecUid(1,k) + ThreadOfModule()*0
          End If
        End If
      End Do
      Return
      End
