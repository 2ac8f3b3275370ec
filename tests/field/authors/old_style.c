/* SPDX-License-Identifier: MIT */
/* C: definition in the style before ANSI, no prototypes, a plain name with the underscore written out */
extern double sqrt();
int calls_of_vfric_coef = 0;
int vfric_coef_(fcoef, deriv, nblock, nprops, ntemp, nfields, jflags, rdata, si, ss, sm, props, rate, pressure, temp, field)
double *fcoef, *deriv, *rdata, *props, *rate, *pressure, *temp, *field;
int *nblock, *nprops, *ntemp, *nfields, *jflags;
char *si, *ss, *sm;
{
  register int k;
  calls_of_vfric_coef++;
  for (k = 0; k < *nblock; k++)
    fcoef[k] = props[0] / sqrt(1.0 + pressure[k] / props[1]) + 0.001 * rate[k];
  return 0;
}
