/* A layer between the program and its Vulkan driver that takes the graphics device away, as a driver does that was
 * reset: from one submission on, whatever is asked of that device is answered with VK_ERROR_DEVICE_LOST. Devices that
 * are opened later work.
 *
 * LOSE_DEVICE names a file; the first submission after it was made loses the device, and the layer removes the file.
 * REFUSE_DEVICES names another; as long as it is there, no device can be opened.
 *
 * Of Vulkan's types only what is read here is declared, so that no headers are needed. The interface is version 2 of
 * the Vulkan loader's for layers.
 */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef int32_t Result;
typedef void (*Function)(void);
typedef Function (*Find)(void *handle, const char *name);

enum { SUCCESS = 0, INITIALIZATION_FAILED = -3, DEVICE_LOST = -4 };
enum { OF_INSTANCE = 47, OF_DEVICE = 48, LINK = 0 };

/* The layer below: how it finds functions of the instance and, for a device, of the device. */
struct Link {
    struct Link *below;
    Find of_instance;
    Find of_device;
};

/* How every "create info" begins; the loader's go on with what they carry. */
struct Info {
    int32_t type;
    struct Info *next;
    int32_t carries;
    struct Link *link;
};

struct Device {
    void *handle;
    /* Where the handle's first word points: the same for a device and its queues. */
    void *table;
    Find find;
    int is_lost;
};

enum { MOST_DEVICES = 16 };
static struct Device devices[MOST_DEVICES];
static Find find_of_instance;
static void *newest_instance;

static struct Device *device_of(void *handle) {
    for (int i = 0; i < MOST_DEVICES; i++)
        if (devices[i].table == *(void **)handle) return &devices[i];
    abort();
}

static int is_there(const char *variable) {
    const char *file = getenv(variable);
    return file && access(file, F_OK) == 0;
}

/* Takes the link meant for this layer and leaves the next one for the layer below. */
static struct Link *take_link(struct Info *info, int32_t type) {
    while (info && !(info->type == type && info->carries == LINK)) info = info->next;
    if (!info) return NULL;
    struct Link *link = info->link;
    info->link = link->below;
    return link;
}

static Result create_instance(struct Info *info, void *allocator, void **instance) {
    struct Link *link = take_link(info->next, OF_INSTANCE);
    if (!link) return INITIALIZATION_FAILED;
    find_of_instance = link->of_instance;
    Result (*create)(struct Info *, void *, void **) = (void *)link->of_instance(NULL, "vkCreateInstance");
    Result created = create(info, allocator, instance);
    if (created == SUCCESS) newest_instance = *instance;
    return created;
}

static Result create_device(void *physical, struct Info *info, void *allocator, void **device) {
    struct Link *link = take_link(info->next, OF_DEVICE);
    if (!link || is_there("REFUSE_DEVICES")) return INITIALIZATION_FAILED;
    Result (*create)(void *, struct Info *, void *, void **) =
        (void *)link->of_instance(newest_instance, "vkCreateDevice");
    Result created = create(physical, info, allocator, device);
    if (created != SUCCESS) return created;
    void *table = *(void **)*device;
    int i = 0;
    while (i < MOST_DEVICES - 1 && devices[i].table && devices[i].table != table) i++;
    devices[i] = (struct Device){*device, table, link->of_device, 0};
    return SUCCESS;
}

/* A function that a lost device answers itself, and that goes to the driver before. */
#define UNLESS_LOST(name, entry, parameters, ...)                                       \
    static Result name parameters {                                                     \
        struct Device *device = device_of(of);                                          \
        if (device->is_lost) return DEVICE_LOST;                                        \
        Result(*real) parameters = (void *)device->find(device->handle, entry);         \
        return real(__VA_ARGS__);                                                       \
    }

UNLESS_LOST(submit, "vkQueueSubmit", (void *of, uint32_t n, void *submits, uint64_t fence), of, n, submits, fence)
UNLESS_LOST(present, "vkQueuePresentKHR", (void *of, void *info), of, info)
UNLESS_LOST(wait_semaphores, "vkWaitSemaphores", (void *of, void *info, uint64_t time), of, info, time)
UNLESS_LOST(value, "vkGetSemaphoreCounterValue", (void *of, uint64_t it, uint64_t *value), of, it, value)
UNLESS_LOST(fence_status, "vkGetFenceStatus", (void *of, uint64_t fence), of, fence)
UNLESS_LOST(wait_fences, "vkWaitForFences", (void *of, uint32_t n, uint64_t *fences, uint32_t all, uint64_t time),
            of, n, fences, all, time)
UNLESS_LOST(acquire, "vkAcquireNextImageKHR",
            (void *of, uint64_t chain, uint64_t time, uint64_t semaphore, uint64_t fence, uint32_t *image),
            of, chain, time, semaphore, fence, image)

static Result submit_or_lose(void *queue, uint32_t n, void *submits, uint64_t fence) {
    const char *signal = getenv("LOSE_DEVICE");
    if (signal && unlink(signal) == 0) device_of(queue)->is_lost = 1;
    return submit(queue, n, submits, fence);
}

static const struct {
    const char *name;
    void *function;
} OURS[] = {
    {"vkCreateInstance", create_instance},
    {"vkCreateDevice", create_device},
    {"vkQueueSubmit", submit_or_lose},
    {"vkQueuePresentKHR", present},
    {"vkWaitSemaphores", wait_semaphores},
    {"vkWaitSemaphoresKHR", wait_semaphores},
    {"vkGetSemaphoreCounterValue", value},
    {"vkGetSemaphoreCounterValueKHR", value},
    {"vkGetFenceStatus", fence_status},
    {"vkWaitForFences", wait_fences},
    {"vkAcquireNextImageKHR", acquire},
};

static Function ours(const char *name) {
    for (size_t i = 0; i < sizeof OURS / sizeof *OURS; i++)
        if (strcmp(name, OURS[i].name) == 0) return (Function)OURS[i].function;
    return NULL;
}

static Function find_in_device(void *handle, const char *name) {
    Function found = ours(name);
    return found ? found : device_of(handle)->find(handle, name);
}

static Function find_in_instance(void *instance, const char *name) {
    if (strcmp(name, "vkGetInstanceProcAddr") == 0) return (Function)find_in_instance;
    if (strcmp(name, "vkGetDeviceProcAddr") == 0) return (Function)find_in_device;
    Function found = ours(name);
    return found || !find_of_instance ? found : find_of_instance(instance, name);
}

/* What the loader and a layer say to each other first. */
struct Negotiation {
    int32_t type;
    void *next;
    uint32_t version;
    Find of_instance;
    Find of_device;
    Find of_physical_device;
};

__attribute__((visibility("default"))) Result vkNegotiateLoaderLayerInterfaceVersion(struct Negotiation *with) {
    if (with->version < 2) return INITIALIZATION_FAILED;
    *with = (struct Negotiation){with->type, with->next, 2, find_in_instance, find_in_device, NULL};
    return SUCCESS;
}
