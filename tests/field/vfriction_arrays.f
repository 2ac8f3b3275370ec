c     SPDX-License-Identifier: MIT
c     Arrays of the thread instead of COMMON, behind Cray pointers.
      subroutine vfriction(fTangential,state,nBlock,nBlockAnal,nBlockEdge,nNodState,nNodSlv,nNodMst,
     *   nFricDir,nDir,nStates,nProps,nTemp,nFields,jFlags,rData,surfInt,surfSlv,surfMst,jConSlvUid,
     *   jConMstUid,props,dSlipFric,fStickForce,fTangPrev,fNormal,areaCont,dircosN,dircosSl,shapeSlv,
     *   shapeMst,coordSlv,coordMst,velSlv,velMst,tempSlv,tempMst,fieldSlv,fieldMst)
      include 'vaba_param.inc'
#include <SMAAspUserSubroutines.hdr>
      dimension fTangential(nFricDir,nBlock),props(nProps),fStickForce(nBlock),fNormal(nBlock)
      character*80 surfInt,surfSlv,surfMst
      integer(8) where
      pointer (ptrSums, sums)
      real*8 sums(2)
      where = SMALocalFloatArrayAccess(17)
      if (where .eq. 0) where = SMALocalFloatArrayCreate(17, 2, 0.0d0)
      ptrSums = where
      do k = 1, nBlock
        fTangential(1,k) = -min(props(1)*fNormal(k), fStickForce(k))
        sums(1) = sums(1) + fNormal(k)
      end do
      if (props(2) .lt. 0) call xplb_abqerr(-2,'SUM %R', 0, sums(1), ' ')
      if (props(2) .lt. 0) call xplb_exit
      end
