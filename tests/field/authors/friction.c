/* SPDX-License-Identifier: MIT */
/* C: FRIC with FOR_NAME, omi_for_c.h, SMAAspUserSubroutines.h, const arguments, lengths of names at the end, 1-based macros */
#include <math.h>
#include <string.h>
#include <omi_for_c.h>
#include <SMAAspUserSubroutines.h>
#define TAU(i) tau[(i)-1]
#define DDTDDG(i, j) ddtddg[((j)-1) * *nfdir + (i)-1]
extern void FOR_NAME(stdb_abqerr, STDB_ABQERR)(int *, char *, int *, double *, char *, int, int);
static int same(const char *name, const char *what, size_t n)
{
  while (n > 0 && name[n - 1] == ' ')
    n--;
  return n == strlen(what) && strncmp(name, what, n) == 0;
}
void FOR_NAME(fric, FRIC)(int *lm, double *tau, double *ddtddg, double *ddtddp, double *dslip, double *sed, double *sfd,
                          double *ddtddt, double *pnewdt, double *statev, const double *dgam, const double *taulm,
                          const double *press, const double *dpress, const double *ddpddh, const double *slip,
                          const int *kstep, const int *kinc, const double *time, const double *dtime, const int *noel,
                          const char *ciname, const char *slname, const char *msname, const int *npt, const int *node,
                          const int *npatch, const double *coords, const double *rcoord, const double *drot,
                          const double *temp, const double *predef, const int *nfdir, const int *mcrd, const int *npred,
                          const int *nstatv, const double *chrlngth, const double *props, const int *nprops,
                          long lenci, long lensl, long lenms)
{
  double mu = props[0], scale = *chrlngth * 0.01;
  int a, level = -1, number = *node;
  if (same(ciname, "LUBRICATED", (size_t)lenci))
    mu *= 0.5;
  *lm = 0;
  for (a = 1; a <= *nfdir; ++a) {
    TAU(a) = mu * *press * tanh(dgam[a - 1] / scale);
    DDTDDG(a, a) = mu * *press / scale / pow(cosh(dgam[a - 1] / scale), 2);
    ddtddp[a - 1] = mu * tanh(dgam[a - 1] / scale);
  }
  if (*press > props[1])
    FOR_NAME(stdb_abqerr, STDB_ABQERR)(&level, "LARGE PRESSURE AT NODE %I", &number, &mu, " ", 25, 1);
}
