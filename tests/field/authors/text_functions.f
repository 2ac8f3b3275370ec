C     SPDX-License-Identifier: MIT
C     CHARACTER*(*) FUNCTION, INDEX, internal READ and WRITE of names, NAMELIST, COMMON with text, logical masks, DO WHILE, CYCLE
      SUBROUTINE VFRICTION(fTangential,state,nBlock,nBlockAnal,nBlockEdge,nNodState,nNodSlv,nNodMst,nFricDir,nDir,nStates,
     1 nProps,nTemp,nFields,jFlags,rData,surfInt,surfSlv,surfMst,jConSlvUid,jConMstUid,props,dSlipFric,fStickForce,fTangPrev,
     2 fNormal,areaCont,dircosN,dircosSl,shapeSlv,shapeMst,coordSlv,coordMst,velSlv,velMst,tempSlv,tempMst,fieldSlv,fieldMst)
      INCLUDE 'VABA_PARAM.INC'
      CHARACTER*80 surfInt,surfSlv,surfMst
      CHARACTER*80 KUPPER, name
      CHARACTER*8 lastName
      COMMON /KNAMES/ lastName
      DIMENSION fTangential(nFricDir,nBlock),props(nProps),fStickForce(nBlock),fNormal(nBlock)
      EXTERNAL KUPPER
      NAMELIST /frict/ numLaw, xscale
      name = KUPPER(surfInt)
      iDash = INDEX(name, '-')
      numLaw = 0
      IF (iDash .GT. 0) READ(name(iDash+1:iDash+2), '(I2)') numLaw
      lastName = name(1:8)
      xscale = 1
      k = 0
      DO WHILE (k .LT. nBlock)
        k = k + 1
        IF (fNormal(k) .LE. 0) CYCLE
        fTangential(1,k) = -MIN(props(numLaw)*fNormal(k)*xscale, fStickForce(k))
      END DO
      RETURN
      END
      CHARACTER*(*) FUNCTION KUPPER(text)
      CHARACTER*(*) text
      KUPPER = text
      DO 10 I = 1, LEN(text)
        J = ICHAR(text(I:I))
        IF (J .GE. 97 .AND. J .LE. 122) KUPPER(I:I) = CHAR(J - 32)
   10 CONTINUE
      END
