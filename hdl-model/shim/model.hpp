// A model of the RTL as its caller sees it: ports by number, a clock edge, a trace.
#pragma once

#include <cstdint>
#include <vector>

#include "verilated.h"
#include "verilated_fst_c.h"

// A port, and where the model keeps it.
struct Port {
    const char *name;
    bool input;
    uint32_t width;
    void *at;
};

// A model of any module.
struct Model {
    VerilatedContext context;
    std::vector<Port> ports;
    VerilatedFstC *trace = nullptr;

    virtual ~Model() = default;
    virtual void eval() = 0;
    // Whether the file could be opened.
    virtual bool open_trace(const char *path) = 0;

    template <class T> void add(const char *name, bool input, uint32_t width, T *at) {
        ports.push_back({name, input, width, static_cast<void *>(at)});
    }
};

// A model of one module; only some can write a trace.
template <class Rtl, bool traces> struct Made : Model {
    Rtl rtl{&context};

    ~Made() override {
        if (trace) {
            trace->close();
            delete trace;
        }
        rtl.final();
    }
    void eval() override { rtl.eval(); }
    bool open_trace(const char *path) override {
        if constexpr (traces) {
            context.traceEverOn(true);
            trace = new VerilatedFstC;
            rtl.trace(trace, 99);
            trace->open(path);
            return trace->isOpen();
        }
        return false;
    }
};

// Makers of all models, by name; the last row is empty.
struct Row {
    const char *name;
    Model *(*make)();
};
extern const Row rows[];
