// The C functions by which Rust drives a model.
#include "model.hpp"

#include <cstring>

extern "C" {

// The model of this name, or null.
Model *rtl_make(const char *name) {
    for (const Row *row = rows; row->name; ++row) {
        if (std::strcmp(row->name, name) == 0) return row->make();
    }
    return nullptr;
}

void rtl_drop(Model *model) { delete model; }

void rtl_eval(Model *model) { model->eval(); }

uint32_t rtl_ports(const Model *model) { return model->ports.size(); }

const char *rtl_port_name(const Model *model, uint32_t port) { return model->ports[port].name; }

uint32_t rtl_port_width(const Model *model, uint32_t port) { return model->ports[port].width; }

bool rtl_port_is_input(const Model *model, uint32_t port) { return model->ports[port].input; }

// Bits 64·word and up of a port. Verilator keeps up to 8, 16, 32 and 64 bits in integers of these
// sizes, more in words of 32 bits.
uint64_t rtl_get(const Model *model, uint32_t port, uint32_t word) {
    const Port &p = model->ports[port];
    if (p.width <= 8) return *static_cast<const CData *>(p.at);
    if (p.width <= 16) return *static_cast<const SData *>(p.at);
    if (p.width <= 32) return *static_cast<const IData *>(p.at);
    if (p.width <= 64) return *static_cast<const QData *>(p.at);
    const EData *words = static_cast<const EData *>(p.at);
    uint64_t low = words[2 * word];
    uint64_t high = 64 * word + 32 < p.width ? words[2 * word + 1] : 0;
    return high << 32 | low;
}

// Sets them; bits beyond the width must be zero.
void rtl_set(Model *model, uint32_t port, uint32_t word, uint64_t value) {
    const Port &p = model->ports[port];
    if (p.width <= 8) *static_cast<CData *>(p.at) = value;
    else if (p.width <= 16) *static_cast<SData *>(p.at) = value;
    else if (p.width <= 32) *static_cast<IData *>(p.at) = value;
    else if (p.width <= 64) *static_cast<QData *>(p.at) = value;
    else {
        EData *words = static_cast<EData *>(p.at);
        words[2 * word] = value;
        if (64 * word + 32 < p.width) words[2 * word + 1] = value >> 32;
    }
}

bool rtl_open_trace(Model *model, const char *path) { return model->open_trace(path); }

void rtl_dump(Model *model, uint64_t time) { model->trace->dump(time); }

} // extern "C"
