/* SPDX-License-Identifier: MIT */
/* Prepared calls for Python: one C call with one pointer behind a callable without arguments.
 *
 * A Python closure over a cffi function costs half as much again as the call of cffi itself; this
 * type costs less than that call. It frees the GIL like cffi and leaves everything but the call to
 * Python: a status other than zero goes to `check`, which raises or returns it. */
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <stddef.h>
#include <stdint.h>
#include <structmember.h>

typedef struct prepared {
  PyObject_HEAD vectorcallfunc vectorcall;
  int32_t (*function)(void *driver);
  void *driver;
  PyObject *check; /* check(status), called where the status is not zero; None: in use */
  int busy;        /* a thread is in the call; read and written with the GIL only */
} prepared;

static PyObject *prepared_call(PyObject *self, PyObject *const *arguments, size_t count,
                               PyObject *names) {
  (void)arguments;
  prepared *me = (prepared *)self;
  if (PyVectorcall_NARGS(count) != 0 || (names && PyTuple_GET_SIZE(names) != 0)) {
    PyErr_SetString(PyExc_TypeError, "a prepared call takes no arguments");
    return NULL;
  }
  if (me->busy)
    return PyObject_CallOneArg(me->check, Py_None);
  int32_t status;
  me->busy = 1;
  Py_BEGIN_ALLOW_THREADS;
  status = me->function(me->driver);
  Py_END_ALLOW_THREADS;
  me->busy = 0;
  if (status != 0)
    return PyObject_CallFunction(me->check, "i", (int)status);
  return PyLong_FromLong(0);
}

static PyObject *prepared_new(PyTypeObject *type, PyObject *arguments, PyObject *names) {
  static char *keywords[] = {"function", "driver", "check", NULL};
  Py_ssize_t function = 0, driver = 0;
  PyObject *check = NULL;
  if (!PyArg_ParseTupleAndKeywords(arguments, names, "nnO", keywords, &function, &driver, &check))
    return NULL;
  prepared *me = (prepared *)type->tp_alloc(type, 0);
  if (!me)
    return NULL;
  me->vectorcall = prepared_call;
  me->function = (int32_t(*)(void *))(uintptr_t)function;
  me->driver = (void *)(uintptr_t)driver;
  me->check = Py_NewRef(check);
  return (PyObject *)me;
}

static int prepared_traverse(prepared *me, visitproc visit, void *arg) {
  Py_VISIT(Py_TYPE(me));
  Py_VISIT(me->check);
  return 0;
}

static int prepared_clear(prepared *me) {
  Py_CLEAR(me->check);
  return 0;
}

static void prepared_dealloc(prepared *me) {
  PyTypeObject *type = Py_TYPE(me);
  PyObject_GC_UnTrack(me);
  prepared_clear(me);
  type->tp_free(me);
  Py_DECREF(type);
}

static PyMemberDef members[] = {
    {"__vectorcalloffset__", T_PYSSIZET, offsetof(prepared, vectorcall), READONLY, NULL},
    {NULL, 0, 0, 0, NULL},
};

static PyType_Slot slots[] = {
    {Py_tp_doc, "Prepared(function, driver, check): calls function(driver), two addresses."},
    {Py_tp_new, prepared_new},
    {Py_tp_call, PyVectorcall_Call},
    {Py_tp_traverse, prepared_traverse},
    {Py_tp_clear, prepared_clear},
    {Py_tp_dealloc, prepared_dealloc},
    {Py_tp_members, members},
    {0, NULL},
};

static PyType_Spec spec = {
    .name = "usersub._prepared.Prepared",
    .basicsize = sizeof(prepared),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_HAVE_GC | Py_TPFLAGS_HAVE_VECTORCALL |
             Py_TPFLAGS_IMMUTABLETYPE,
    .slots = slots,
};

static int execute(PyObject *module) {
  PyObject *type = PyType_FromModuleAndSpec(module, &spec, NULL);
  if (!type)
    return -1;
  const int result = PyModule_AddType(module, (PyTypeObject *)type);
  Py_DECREF(type);
  return result;
}

static PyModuleDef_Slot module_slots[] = {{Py_mod_exec, execute}, {0, NULL}};

static PyModuleDef module = {
    PyModuleDef_HEAD_INIT,
    .m_name = "usersub._prepared",
    .m_doc = "Prepared calls of drivers.",
    .m_slots = module_slots,
};

PyMODINIT_FUNC PyInit__prepared(void) {
  return PyModuleDef_Init(&module);
}
