/* SPDX-License-Identifier: MIT */
/* C: VFRIC, static counter, printf, MutexInit and MutexLock by value, thread-local array, structs over columns */
#include <stdio.h>
#include "omi_for_c.h"
#include "SMAAspUserSubroutines.h"
typedef struct { double x, y, z; } vector;
static double dot(const vector *a, const vector *b) { return a->x * b->x + a->y * b->y + a->z * b->z; }
static int calls;
void FOR_NAME(vfric, VFRIC)(double *fTangential, double *statev, int *kStep, int *kInc, int *nContact, int *nFacNod,
    int *nSecNod, int *nMainNod, int *nFricDir, int *nDir, int *nStateVar, int *nProps, int *nTemp, int *nPred,
    int *numDefTfv, int *jSecUid, int *jMainUid, int *jConSecid, int *jConMainid, double *timStep, double *timGlb,
    double *dTimCur, char *surfInt, char *surfSec, char *surfMain, int *lContType, vector *dSlipFric,
    double *fStickForce, vector *fTangPrev, double *fNormal, double *frictionWork, double *shape, vector *coordSec,
    vector *coordMain, vector *dirCosSl, vector *dircosN, double *props, double *areaSec, double *tempSec,
    double *preDefSec, double *tempMain, double *preDefMain)
{
  if (calls++ == 0) {
    MutexInit(3);
    SMALocalFloatArrayCreate(21, 4, 0.0);
  }
  MutexLock(3);
  double *mine = SMALocalFloatArrayAccess(21);
  mine[get_thread_id()] += *nContact;
  MutexUnlock(3);
  for (int i = 0; i < *nContact; i++) {
    const vector *at = &coordSec[jConSecid[i] - 1];
    double ft = props[0] * fNormal[i] * (1 + props[1] * dot(at, &dircosN[i]));
    fTangential[i * *nFricDir] = -(ft < fStickForce[i] ? ft : fStickForce[i]);
  }
  if (*kInc < 0) printf("never %d\n", calls);
}
