/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * FMI 3.0: values. All variables are of type Float64.
 */
#include "fmi/fmi3.h"
#include "fmi/instance.h"

/* NOLINTBEGIN(readability-non-const-parameter): the standard dictates the parameters. */

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
                          fmi3Float64 values[], size_t value_count)
{
    if (!instance_allows(instance, phase_any, "fmi3GetFloat64")) return fmi3Error;
    if (count != value_count)
        return (fmi3Status)instance_fail(instance, "fmi3GetFloat64", "every variable has one value");
    return (fmi3Status)instance_get(instance, "fmi3GetFloat64", references, count, values);
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
                          const fmi3Float64 values[], size_t value_count)
{
    const unsigned phases = phase_any & ~(unsigned)phase_terminated;
    if (!instance_allows(instance, phases, "fmi3SetFloat64")) return fmi3Error;
    if (count != value_count)
        return (fmi3Status)instance_fail(instance, "fmi3SetFloat64", "every variable has one value");
    return (fmi3Status)instance_set(instance, "fmi3SetFloat64", references, count, values);
}

/* There are no variables of other types. */
static fmi3Status none(struct instance *instance, const char *function, size_t count)
{
    if (!instance_allows(instance, phase_any, function)) return fmi3Error;
    return count == 0 ? fmi3OK : (fmi3Status)instance_fail(instance, function, "no variable is of this type");
}

#define NONE(Type)                                                                                           \
    fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference references[], size_t count,     \
                             fmi3##Type values[], size_t value_count)                                        \
    {                                                                                                        \
        (void)references, (void)values, (void)value_count;                                                   \
        return none(instance, "fmi3Get" #Type, count);                                                       \
    }                                                                                                        \
    fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference references[], size_t count,     \
                             const fmi3##Type values[], size_t value_count)                                  \
    {                                                                                                        \
        (void)references, (void)values, (void)value_count;                                                   \
        return none(instance, "fmi3Set" #Type, count);                                                       \
    }

NONE(Float32)
NONE(Int8)
NONE(UInt8)
NONE(Int16)
NONE(UInt16)
NONE(Int32)
NONE(UInt32)
NONE(Int64)
NONE(UInt64)
NONE(Boolean)
NONE(String)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
                         size_t sizes[], fmi3Binary values[], size_t value_count)
{
    (void)references, (void)sizes, (void)values, (void)value_count;
    return none(instance, "fmi3GetBinary", count);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
                         const size_t sizes[], const fmi3Binary values[], size_t value_count)
{
    (void)references, (void)sizes, (void)values, (void)value_count;
    return none(instance, "fmi3SetBinary", count);
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
                        fmi3Clock values[])
{
    (void)references, (void)values;
    return none(instance, "fmi3GetClock", count);
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
                        const fmi3Clock values[])
{
    (void)references, (void)values;
    return none(instance, "fmi3SetClock", count);
}

/* NOLINTEND(readability-non-const-parameter) */
