/* The compiled kernel; its specification is twin.py. Buffers are the caller's; nothing is allocated, no Python object is touched in loops. */
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <stdint.h>

enum { SHORT_FRAME_BYTES = 36, NUMBER_AT = 3, CRC_BYTES = 4 };

static uint32_t crc_of_byte[256];

static void fill_tables(void) {
    for (uint32_t byte = 0; byte < 256; byte++) {
        uint32_t crc = byte;
        for (int bit = 0; bit < 8; bit++) crc = crc >> 1 ^ (0xEDB88320u & -(crc & 1));
        crc_of_byte[byte] = crc;
    }
}

static uint32_t crc32(const uint8_t *bytes, Py_ssize_t length) {
    uint32_t crc = ~0u;
    for (Py_ssize_t at = 0; at < length; at++) crc = crc >> 8 ^ crc_of_byte[(uint8_t)(crc ^ bytes[at])];
    return ~crc;
}

static void put_u32(uint8_t *to, uint32_t value) {
    for (int at = 0; at < 4; at++) to[at] = (uint8_t)(value >> 8 * at);
}

static PyObject *seal_short_frames(PyObject *module, PyObject *const *args, Py_ssize_t given) {
    (void)module;
    if (given != 4) return PyErr_Format(PyExc_TypeError, "seal_short_frames takes 4 arguments, not %zd", given);
    Py_ssize_t start = PyLong_AsSsize_t(args[1]);
    if (start == -1 && PyErr_Occurred()) return NULL;
    Py_ssize_t count = PyLong_AsSsize_t(args[2]);
    if (count == -1 && PyErr_Occurred()) return NULL;
    unsigned long sequence = PyLong_AsUnsignedLongMask(args[3]);
    if (sequence == (unsigned long)-1 && PyErr_Occurred()) return NULL;
    Py_buffer out;
    if (PyObject_GetBuffer(args[0], &out, PyBUF_WRITABLE)) return NULL;
    if (start < 0 || count < 0 || start > out.len || count > (out.len - start) / SHORT_FRAME_BYTES) {
        PyErr_Format(PyExc_ValueError, "%zd frames from byte %zd on do not fit into %zd bytes", count, start, out.len);
        PyBuffer_Release(&out);
        return NULL;
    }
    uint8_t *frame = (uint8_t *)out.buf + start;
    for (Py_ssize_t number = 0; number < count; number++, frame += SHORT_FRAME_BYTES) {
        frame[NUMBER_AT] = (uint8_t)(sequence + number);
        put_u32(frame + SHORT_FRAME_BYTES - CRC_BYTES, crc32(frame, SHORT_FRAME_BYTES - CRC_BYTES));
    }
    PyBuffer_Release(&out);
    Py_RETURN_NONE;
}

static PyMethodDef methods[] = {
    {"seal_short_frames", (PyCFunction)(void (*)(void))seal_short_frames, METH_FASTCALL, "seal_short_frames(out, start, count, sequence)"},
    {NULL, NULL, 0, NULL},
};

static struct PyModuleDef module = {PyModuleDef_HEAD_INIT, .m_name = "controller.kernel._kernel", .m_size = -1, .m_methods = methods};

PyMODINIT_FUNC PyInit__kernel(void) {
    fill_tables();
    return PyModule_Create(&module);
}
