/* The compiled kernel: see twin.py, its specification. Buffers belong to the caller; nothing is allocated in loops. */
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <stdint.h>

static uint32_t crc_of_byte[256];

static void fill_tables(void) {
    for (uint32_t byte = 0; byte < 256; byte++) {
        uint32_t crc = byte;
        for (int bit = 0; bit < 8; bit++) crc = crc >> 1 ^ (0xEDB88320u & -(crc & 1));
        crc_of_byte[byte] = crc;
    }
}

static PyObject *crc32(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    (void)module;
    if (count != 1) {
        PyErr_Format(PyExc_TypeError, "crc32 takes 1 argument (%zd given)", count);
        return NULL;
    }
    Py_buffer data;
    if (PyObject_GetBuffer(args[0], &data, PyBUF_SIMPLE)) return NULL;
    const uint8_t *bytes = data.buf;
    uint32_t crc = ~0u;
    for (Py_ssize_t at = 0; at < data.len; at++) crc = crc >> 8 ^ crc_of_byte[(uint8_t)(crc ^ bytes[at])];
    PyBuffer_Release(&data);
    return PyLong_FromUnsignedLong(~crc & 0xFFFFFFFFu);
}

static PyMethodDef methods[] = {
    {"crc32", (PyCFunction)(void (*)(void))crc32, METH_FASTCALL, "crc32(data) -> int"},
    {NULL, NULL, 0, NULL},
};

static struct PyModuleDef module = {PyModuleDef_HEAD_INIT, .m_name = "controller.kernel._kernel", .m_size = -1, .m_methods = methods};

PyMODINIT_FUNC PyInit__kernel(void) {
    fill_tables();
    return PyModule_Create(&module);
}
