#include "io/topology.h"

static bool is_shed_axis(const FrPlant *plant, uint32_t axis) {
    return plant->axes.first[axis] == FR_NONE || (plant->axes.flags[axis] & FR_SHED) != 0 ||
           (plant->nodes.flags[plant->axes.first[axis]] & FR_SHED) != 0;
}

uint32_t fr_topology_next(const FrTopology *topology, uint32_t node) {
    const FrPlant *plant = topology->plant;
    uint32_t next = plant->nodes.next[node];
    if (next != FR_NONE) {
        return (plant->nodes.flags[next] & FR_SHED) == 0 ? next : FR_NONE;
    }
    for (uint32_t axis = topology->first_axis[node]; axis != FR_NONE;
         axis = topology->next_axis[axis]) {
        if ((plant->axes.flags[axis] & FR_CONTINUES) != 0) {
            return plant->axes.first[axis];
        }
    }
    return FR_NONE;
}

static void link_axes(FrTopology *topology) {
    const FrAxes *axes = &topology->plant->axes;
    for (uint32_t axis = axes->count; axis-- > 0;) {
        if (!is_shed_axis(topology->plant, axis)) {
            uint32_t bearer = axes->bearer[axis];
            uint32_t *head =
                bearer != FR_NONE ? &topology->first_axis[bearer] : &topology->first_stem;
            topology->next_axis[axis] = *head;
            *head = axis;
        }
    }
}

static void link_organs(FrTopology *topology) {
    const FrOrgans *organs = &topology->plant->organs;
    for (uint32_t organ = organs->count; organ-- > 0;) {
        if ((organs->flags[organ] & FR_SHED) == 0) {
            uint32_t node = organs->node[organ];
            uint32_t *head =
                node != FR_NONE ? &topology->first_organ[node] : &topology->first_loose;
            topology->next_organ[organ] = *head;
            *head = organ;
        }
    }
}

static uint32_t *none(uint32_t count) {
    uint32_t *column = g_new(uint32_t, MAX(count, 1));
    for (uint32_t i = 0; i < count; i++) {
        column[i] = FR_NONE;
    }
    return column;
}

void fr_topology_init(FrTopology *topology, const FrPlant *plant) {
    *topology = (FrTopology){
        .plant = plant,
        .first_axis = none(plant->nodes.count),
        .next_axis = none(plant->axes.count),
        .first_organ = none(plant->nodes.count),
        .next_organ = none(plant->organs.count),
        .first_stem = FR_NONE,
        .first_loose = FR_NONE,
    };
    link_axes(topology);
    link_organs(topology);
}

void fr_topology_clear(FrTopology *topology) {
    g_free(topology->first_axis);
    g_free(topology->next_axis);
    g_free(topology->first_organ);
    g_free(topology->next_organ);
}

/// A step to be taken, or to be left again.
typedef struct FrTopologyTask {
    FrTopologyStep step;
    bool is_left;
} FrTopologyTask;

/// The step to the internode that begins with a node: what is bent ends with its last part.
static FrTopologyStep step_to(const FrTopology *topology, uint32_t first, uint32_t axis,
                              uint32_t order) {
    const FrNodes *nodes = &topology->plant->nodes;
    FrTopologyStep step = {first, first, axis, order};
    while ((nodes->flags[step.node] & FR_PART) != 0 && nodes->next[step.node] != FR_NONE &&
           (nodes->flags[nodes->next[step.node]] & FR_SHED) == 0 &&
           topology->first_axis[step.node] == FR_NONE &&
           topology->first_organ[step.node] == FR_NONE) {
        step.node = nodes->next[step.node];
    }
    return step;
}

double fr_topology_length(const FrTopology *topology, const FrTopologyStep *step) {
    const FrNodes *nodes = &topology->plant->nodes;
    double length = (double)nodes->length[step->first];
    for (uint32_t part = step->first; part != step->node;) {
        part = nodes->next[part];
        length += (double)nodes->length[part];
    }
    return length;
}

/// Puts the branches of an internode, the first on top, above what goes on from it.
static void add_tasks(const FrTopology *topology, const FrTopologyStep *step, GArray *tasks) {
    uint32_t next = fr_topology_next(topology, step->node);
    if (next != FR_NONE) {
        FrTopologyTask on = {step_to(topology, next, FR_NONE, step->order), false};
        g_array_append_val(tasks, on);
    }
    guint low = tasks->len;
    for (uint32_t axis = topology->first_axis[step->node]; axis != FR_NONE;
         axis = topology->next_axis[axis]) {
        uint32_t first = topology->plant->axes.first[axis];
        FrTopologyTask branch = {step_to(topology, first, axis, step->order + 1), false};
        if (first != next) {
            g_array_append_val(tasks, branch);
        }
    }
    for (guint high = tasks->len; low + 1 < high; low++, high--) {
        FrTopologyTask *a = &g_array_index(tasks, FrTopologyTask, low);
        FrTopologyTask *b = &g_array_index(tasks, FrTopologyTask, high - 1);
        FrTopologyTask swap = *a;
        *a = *b;
        *b = swap;
    }
}

void fr_topology_walk(const FrTopology *topology, uint32_t stem,
                      bool (*enter)(void *user, const FrTopologyStep *step),
                      void (*leave)(void *user, const FrTopologyStep *step), void *user) {
    GArray *tasks = g_array_new(FALSE, FALSE, sizeof(FrTopologyTask));
    FrTopologyTask first = {step_to(topology, topology->plant->axes.first[stem], stem, 0), false};
    g_array_append_val(tasks, first);
    bool goes_on = true;
    while (tasks->len > 0 && goes_on) {
        FrTopologyTask task = g_array_index(tasks, FrTopologyTask, tasks->len - 1);
        g_array_set_size(tasks, tasks->len - 1);
        if (task.is_left) {
            leave(user, &task.step);
            continue;
        }
        goes_on = enter(user, &task.step);
        if (leave != NULL) {
            task.is_left = true;
            g_array_append_val(tasks, task);
        }
        add_tasks(topology, &task.step, tasks);
    }
    g_array_unref(tasks);
}
