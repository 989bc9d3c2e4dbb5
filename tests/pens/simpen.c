/*
 * Input driver of an X server for pens that exist only in tests.
 *
 * Each device listens on a datagram socket (option "Socket") for one line of text a packet:
 *
 *     in AXES | out AXES | move AXES | press BUTTON AXES | release BUTTON AXES
 *
 * where AXES are pairs NUMBER=VALUE of the axes that changed. A device with the option "Hub" also listens there, for
 * what a person does with cables:
 *
 *     plug NAME TYPE SOCKET | unplug NAME
 *
 * Axes are those of a common tablet: place, pressure, tilt in degrees, wheel.
 */
#include <xorg-server.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <exevents.h>
#include <xf86.h>
#include <xf86Xinput.h>
#include <xserver-properties.h>

#define BUTTONS 9
#define LONGEST_LINE 512

struct axis {
    const char *label;
    int min, max, per_unit;
};

static const struct axis axes[] = {
    {AXIS_LABEL_PROP_ABS_X, 0, 44800, 200000},   {AXIS_LABEL_PROP_ABS_Y, 0, 29600, 200000},
    {AXIS_LABEL_PROP_ABS_PRESSURE, 0, 65536, 1}, {AXIS_LABEL_PROP_ABS_TILT_X, -64, 63, 57},
    {AXIS_LABEL_PROP_ABS_TILT_Y, -64, 63, 57},   {AXIS_LABEL_PROP_ABS_WHEEL, -900, 899, 1},
};
#define AXES ((int)(sizeof axes / sizeof *axes))

static int listen_at(const char *path)
{
    struct sockaddr_un at = {.sun_family = AF_UNIX};
    int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    snprintf(at.sun_path, sizeof at.sun_path, "%s", path);
    unlink(path);
    if (fd >= 0 && bind(fd, (struct sockaddr *)&at, sizeof at) == 0)
        return fd;
    if (fd >= 0)
        close(fd);
    return -1;
}

/* One line without its end; 0 when there is none. */
static int next_line(int fd, char line[LONGEST_LINE])
{
    ssize_t length = recv(fd, line, LONGEST_LINE - 1, MSG_DONTWAIT);
    if (length <= 0)
        return 0;
    line[length] = '\0';
    return 1;
}

static void read_axes(const char *text, ValuatorMask *mask)
{
    int number, used;
    double value;
    while (sscanf(text, " %d=%lf%n", &number, &value, &used) == 2) {
        if (number >= 0 && number < AXES)
            valuator_mask_set_double(mask, number, value);
        text += used;
    }
}

static void obey(DeviceIntPtr device, const char *line, ValuatorMask *mask)
{
    char verb[16];
    int used = 0, button = 0, more = 0;
    if (sscanf(line, "%15s%n", verb, &used) != 1)
        return;
    valuator_mask_zero(mask);
    if (!strcmp(verb, "press") || !strcmp(verb, "release")) {
        if (sscanf(line + used, " %d%n", &button, &more) != 1)
            return;
        read_axes(line + used + more, mask);
        xf86PostButtonEventM(device, Absolute, button, !strcmp(verb, "press"), mask);
        return;
    }
    read_axes(line + used, mask);
    if (!strcmp(verb, "move"))
        xf86PostMotionEventM(device, Absolute, mask);
    else
        xf86PostProximityEventM(device, !strcmp(verb, "in"), mask);
}

static void read_input(InputInfoPtr info)
{
    char line[LONGEST_LINE];
    ValuatorMask *mask = valuator_mask_new(AXES);
    while (next_line(info->fd, line))
        obey(info->dev, line, mask);
    valuator_mask_free(&mask);
}

static void plug(const char *name, const char *type, const char *path)
{
    DeviceIntPtr device;
    InputOption *options = input_option_new(NULL, "name", name);
    options = input_option_new(options, "driver", "simpen");
    options = input_option_new(options, "Type", type);
    options = input_option_new(options, "Socket", path);
    NewInputDeviceRequest(options, NULL, &device);
    input_option_free_list(&options);
}

static void unplug(const char *name)
{
    for (InputInfoPtr info = xf86FirstLocalDevice(); info; info = info->next) {
        if (!strcmp(info->name, name)) {
            DeleteInputDeviceRequest(info->dev);
            return;
        }
    }
}

/* Runs on the server's main thread, where devices may come and go. */
static void read_hub(int fd, int ready, void *unused)
{
    char line[LONGEST_LINE], name[64], type[16], path[128];
    (void)ready, (void)unused;
    while (next_line(fd, line)) {
        if (sscanf(line, "plug %63s %15s %127s", name, type, path) == 3)
            plug(name, type, path);
        else if (sscanf(line, "unplug %63s", name) == 1)
            unplug(name);
    }
}

static void control_feedback(DeviceIntPtr device, PtrCtrl *control)
{
    (void)device, (void)control;
}

static void describe(DeviceIntPtr device)
{
    unsigned char map[BUTTONS + 1];
    Atom buttons[BUTTONS] = {0}, labels[AXES];
    for (int i = 0; i <= BUTTONS; i++)
        map[i] = (unsigned char)i;
    for (int i = 0; i < AXES; i++)
        labels[i] = XIGetKnownProperty(axes[i].label);
    InitButtonClassDeviceStruct(device, BUTTONS, buttons, map);
    InitValuatorClassDeviceStruct(device, AXES, labels, GetMotionHistorySize(), Absolute);
    for (int i = 0; i < AXES; i++) {
        const struct axis *axis = &axes[i];
        xf86InitValuatorAxisStruct(device, i, labels[i], axis->min, axis->max, axis->per_unit, 0, axis->per_unit,
                                   Absolute);
        xf86InitValuatorDefaults(device, i);
    }
    InitProximityClassDeviceStruct(device);
    InitPtrFeedbackClassDeviceStruct(device, control_feedback);
}

static int control(DeviceIntPtr device, int what)
{
    InputInfoPtr info = device->public.devicePrivate;
    switch (what) {
    case DEVICE_INIT:
        describe(device);
        break;
    case DEVICE_ON:
        xf86AddEnabledDevice(info);
        device->public.on = TRUE;
        break;
    case DEVICE_OFF:
        xf86RemoveEnabledDevice(info);
        device->public.on = FALSE;
        break;
    }
    return Success;
}

static int begin(InputDriverPtr driver, InputInfoPtr info, int flags)
{
    char *path = xf86SetStrOption(info->options, "Socket", NULL);
    char *hub = xf86SetStrOption(info->options, "Hub", NULL);
    (void)driver, (void)flags;
    info->type_name = xf86SetStrOption(info->options, "Type", "STYLUS");
    info->device_control = control;
    info->read_input = read_input;
    info->fd = path ? listen_at(path) : -1;
    free(path);
    if (info->fd < 0) {
        xf86IDrvMsg(info, X_ERROR, "no socket: %s\n", strerror(errno));
        free(hub);
        return BadValue;
    }
    if (hub) {
        int fd = listen_at(hub);
        if (fd >= 0)
            SetNotifyFd(fd, read_hub, X_NOTIFY_READ, NULL);
        free(hub);
    }
    return Success;
}

static void end(InputDriverPtr driver, InputInfoPtr info, int flags)
{
    (void)driver;
    if (info->fd >= 0)
        close(info->fd);
    info->fd = -1;
    xf86DeleteInput(info, flags);
}

static InputDriverRec driver = {1, "simpen", NULL, begin, end, NULL, NULL, 0};

static void *set_up(void *module, void *options, int *error, int *minor)
{
    (void)options, (void)error, (void)minor;
    xf86AddInputDriver(&driver, module, 0);
    return module;
}

static XF86ModuleVersionInfo version = {
    "simpen",           MODULEVENDORSTRING,  MODINFOSTRING1,    MODINFOSTRING2, XORG_VERSION_CURRENT, 1, 0, 0,
    ABI_CLASS_XINPUT,   ABI_XINPUT_VERSION,  MOD_CLASS_XINPUT,  {0, 0, 0, 0},
};

_X_EXPORT XF86ModuleData simpenModuleData = {&version, set_up, NULL};
